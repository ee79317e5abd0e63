// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

// Every kind of calibration registers itself as a subcommand of `calibrate`.
void add_calibrate_lighthouse(CLI::App& calibrate, int& exit_code);
void add_calibrate_stations(CLI::App& calibrate, int& exit_code);
void add_calibrate_camera(CLI::App& calibrate, int& exit_code);
void add_calibrate_stereo(CLI::App& calibrate, int& exit_code);
void add_calibrate_mounting(CLI::App& calibrate, int& exit_code);

}  // namespace pharos::tools
