// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A program that a test starts, reads from and ends.
class ChildProcess {
 public:
  /// Starts `arguments[0]`, standard output and standard error are both collected in text().
  /// `file_size_limit`: largest file it may write (RLIMIT_FSIZE, SIGXFSZ ignored), 0 = no limit: simulates a full disk.
  explicit ChildProcess(const std::vector<std::string>& arguments, unsigned long file_size_limit = 0);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int pid() const { return pid_; }
  /// Its output so far.
  const std::string& text();
  /// Waits until text() contains `words`; false after `seconds` or when the program ended without.
  bool wait_for(const std::string& words, double seconds = 10.0);
  void signal(int number) const;
  /// Fills the pipe of its standard error, so that it takes no further byte until somebody reads; false if it cannot.
  bool fill_standard_error() const;
  /// Waits for its end: the exit code, 128 + signal, or -1 after `seconds`.
  int wait_exit(double seconds = 10.0);
  /// The same for a program whose output is not read.
  int wait_exit_unread(double seconds);

 private:
  bool has_ended();
  void read_available(int timeout_ms);

  int pid_ = -1;
  int exit_code_ = -1;
  UniqueFd output_;
  std::string text_;
};

}  // namespace pharos::host
