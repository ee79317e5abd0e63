// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A timer as a descriptor (timerfd, monotonic clock) for the event loop.
class Timer {
 public:
  /// Throws std::system_error if no timer can be created.
  Timer();
  int fd() const { return fd_.get(); }
  /// First expiry after `first`, then every `period` (zero: once). A zero `first` expires at once.
  void start(std::chrono::nanoseconds first, std::chrono::nanoseconds period = {});
  void start_every(std::chrono::nanoseconds period) { start(period, period); }
  void stop();
  /// Number of expiries since the last call. Must be called in the handler; otherwise the descriptor stays readable.
  std::uint64_t take_expiries();

 private:
  UniqueFd fd_;
};

}  // namespace pharos::host
