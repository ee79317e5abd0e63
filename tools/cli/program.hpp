// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// The whole program `pharos`: version, footer and every command. Parsing `app` writes the exit code. Apart from
/// `main`, so that the manual pages and completions (tools/manual) come from the same definition.
void add_program(CLI::App& app, int& exit_code);

}  // namespace pharos::tools
