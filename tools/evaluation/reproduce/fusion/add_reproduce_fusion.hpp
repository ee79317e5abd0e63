// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce fusion`: consistency, protection levels and exclusion of the fusion over measurement-level runs.
void add_reproduce_fusion(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
