// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos reproduce stations`: two stations beside motion capture, crossing beams as logged beside ours.
void add_reproduce_stations(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
