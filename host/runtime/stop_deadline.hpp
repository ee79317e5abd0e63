// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <initializer_list>
#include <thread>

#include "host/support/ready_event.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Ends the process a limited time after it was told to stop, whatever hangs: the loop in a disk that does not answer,
/// a thread that is in the middle of its work.
///
/// It looks for the signals itself and takes none from the loop's Signals, which has to call begin() for one that it
/// takes: a signal is seen by one of the two.
class StopDeadline {
 public:
  /// `signals` must be blocked already (Signals does so). Throws std::system_error.
  StopDeadline(std::initializer_list<int> signals, std::chrono::milliseconds limit);
  StopDeadline(const StopDeadline&) = delete;
  StopDeadline& operator=(const StopDeadline&) = delete;
  /// The process goes on: nothing is ended any more.
  ~StopDeadline();

  /// The time runs from the first call on.
  void begin() { begun_.set(); }
  /// With which the process is ended: 1 until told otherwise.
  void set_exit_code(int code) { exit_code_ = code; }

 private:
  void wait(std::chrono::milliseconds limit);

  UniqueFd signals_;
  ReadyEvent begun_, over_;
  std::atomic<int> exit_code_ = 1;
  std::thread thread_;
};

}  // namespace pharos::host
