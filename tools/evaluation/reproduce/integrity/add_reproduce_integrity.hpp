// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

void add_reproduce_integrity(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
