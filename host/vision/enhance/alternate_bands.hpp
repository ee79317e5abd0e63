// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pharos::enhance {

/// band(worker, k) for every k below `bands`, by up to `threads` workers of which the caller is number 0: the even ones
/// in parallel, then the odd ones, so that neighbours are never processed at the same time. The first exception of a
/// band in any thread is thrown to the caller, when all threads have ended; bands not begun by then are skipped.
template <class Band>
void alternate_bands(std::int32_t bands, int threads, Band&& band) {
  const int workers = std::clamp(threads, 1, std::max(1, (bands + 1) / 2));
  std::mutex mutex;
  std::exception_ptr fault;
  for (std::int32_t parity = 0; parity < 2 && !fault; ++parity) {
    std::atomic<std::int32_t> next = parity;
    const auto work = [&](std::size_t worker) {
      try {
        for (std::int32_t k = next.fetch_add(2); k < bands; k = next.fetch_add(2)) band(worker, k);
      } catch (...) {
        next = bands;
        const std::lock_guard lock(mutex);
        if (!fault) fault = std::current_exception();
      }
    };
    std::vector<std::jthread> others;  // joined where the block ends
    for (int k = 1; k < workers; ++k) others.emplace_back(work, static_cast<std::size_t>(k));
    work(0);
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace pharos::enhance
