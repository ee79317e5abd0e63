// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A timer as a descriptor (timerfd, monotonic clock) for the poll loop.
class Timer {
 public:
  /// Throws std::system_error where the kernel gives none.
  Timer();
  int fd() const { return fd_.get(); }
  /// First expiry after `first`, then every `period` (zero: once). A zero `first` expires at once.
  void start(std::chrono::nanoseconds first, std::chrono::nanoseconds period = {});
  void start_every(std::chrono::nanoseconds period) { start(period, period); }
  void stop();
  /// Expiries since the last call; call it in the handler, or the loop turns for ever.
  std::uint64_t take_expiries();

 private:
  UniqueFd fd_;
};

}  // namespace pharos::host
