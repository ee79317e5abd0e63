// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce slam`: table 1 of paper 004 compared with ours.
void add_reproduce_slam(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
