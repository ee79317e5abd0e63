// SPDX-License-Identifier: Apache-2.0
// Loaded before a program (LD_PRELOAD), lets it live in the simulated chip's time: CLOCK_MONOTONIC is what
// chip_terminal writes to the file that PHAROS_CHIP_CLOCK names, and poll() waits in it. So the program's limits are
// those that it has before a real chip, however slow the simulation is.
#include <poll.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>

#include "rtl/chip/chip_clock.hpp"

namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr std::int64_t kNsPerMs = 1'000'000;

std::int64_t chip_ns() {
  static const std::atomic<std::int64_t>* const clock = [] {
    const char* const path = std::getenv("PHAROS_CHIP_CLOCK");
    const auto* const mapped = path == nullptr ? nullptr : pharos::rtl::map_chip_clock(path);
    if (mapped == nullptr) std::abort();
    return mapped;
  }();
  return clock->load();
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (clock != CLOCK_MONOTONIC) return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  const std::int64_t now_ns = chip_ns();
  time->tv_sec = now_ns / kNsPerS;
  time->tv_nsec = now_ns % kNsPerS;
  return 0;
}

extern "C" int poll(pollfd* files, nfds_t count, int timeout_ms) {
  const std::int64_t end_ns = chip_ns() + timeout_ms * kNsPerMs;
  for (;;) {
    constexpr int kLook_ms = 1;
    const int ready = static_cast<int>(::syscall(SYS_poll, files, count, timeout_ms == 0 ? 0 : kLook_ms));
    if (ready != 0 || (timeout_ms >= 0 && chip_ns() >= end_ns)) return ready;
  }
}
