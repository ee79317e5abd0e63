// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

namespace pharos::rtl {

/// The simulated chip's time in a file that other processes map (chip_clock_preload.cpp), ns.
/// Null where the file cannot be mapped. It is never unmapped: a program has one until it ends.
inline std::atomic<std::int64_t>* map_chip_clock(const char* path) {
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return nullptr;
  void* const shared = ::ftruncate(file, sizeof(std::int64_t)) != 0
                           ? MAP_FAILED
                           : ::mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  return shared == MAP_FAILED ? nullptr : static_cast<std::atomic<std::int64_t>*>(shared);
}

}  // namespace pharos::rtl
