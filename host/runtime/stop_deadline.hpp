// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <thread>

#include "host/support/ready_event.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Ends the process a limited time after a request to stop, even if something hangs: the event loop on a disk that does
/// not respond, or a thread in the middle of its work.
///
/// It waits for the signals itself but does not consume those of the loop's Signals. The loop calls begin() for a
/// signal that it has consumed, so that each signal is noticed by one of the two.
class StopDeadline {
 public:
  /// `signals` must be blocked already (Signals does so). Throws std::system_error.
  StopDeadline(std::initializer_list<int> signals, std::chrono::milliseconds limit);
  StopDeadline(const StopDeadline&) = delete;
  StopDeadline& operator=(const StopDeadline&) = delete;
  /// Cancels the deadline: the process is not ended.
  ~StopDeadline();

  /// Starts the time; further calls do nothing.
  void begin() { begun_.set(); }
  /// Exit code with which the process is ended; 1 if not set.
  void set_exit_code(int code) { exit_code_ = code; }

 private:
  void wait(std::chrono::milliseconds limit);

  UniqueFd signals_;
  ReadyEvent begun_, over_;
  std::atomic<int> exit_code_ = 1;
  std::thread thread_;
};

}  // namespace pharos::host
