// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce tof`.
void add_reproduce_tof(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
