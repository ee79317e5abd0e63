// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce ring2`.
void add_reproduce_ring2(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
