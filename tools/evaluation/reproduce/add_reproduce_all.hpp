// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce all`: the report of all papers.
void add_reproduce_all(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
