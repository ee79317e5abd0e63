// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pharos::host {

/// Results of a program that ran to its end.
struct CommandResult {
  int exit_code = -1;  // 128 + signal; 128 + SIGKILL also after the time limit
  std::string text;    // standard output and standard error
  double peak_mib = 0.0;

  /// Whether a signal ended it: it crashed, aborted or hung.
  bool crashed() const { return exit_code < 0 || exit_code > 128; }
};

/// Runs `arguments[0]` with an empty standard input; kills it after `seconds`.
CommandResult run_command(const std::vector<std::string>& arguments, double seconds = 120.0);

}  // namespace pharos::host
