// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace pharos::host {

/// The command line of pharosd.
struct ProgramOptions {
  std::string config;
  std::string replay;
  bool check = false;
  bool fast = false;
};

/// Adds the options, their help and the example to `app`; parsing it fills `options`. A library of its own: the manual
/// page and the completions (tools/manual) come from it without the daemon.
void add_program_options(CLI::App& app, ProgramOptions& options);

}  // namespace pharos::host
