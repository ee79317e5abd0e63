// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::host {

/// The command line of pharos-camera: --help and --version. What it does comes from pharosd over its socket.
void add_camera_program_options(CLI::App& app);

}  // namespace pharos::host
