// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace pharos::tools {

/// `pharos sim …`.
void add_sim(CLI::App& app, int& exit_code);

// Its parts.
void add_sim_lighthouse(CLI::App& sim, int& exit_code);
void add_sim_tof(CLI::App& sim, int& exit_code);
void add_sim_pointing(CLI::App& sim, int& exit_code);
void add_sim_stereo(CLI::App& sim, int& exit_code);
void add_sim_serial(CLI::App& sim, int& exit_code);
void add_sim_camera(CLI::App& sim, int& exit_code);
void add_sim_approach(CLI::App& sim, int& exit_code);
void add_sim_capture(CLI::App& sim, int& exit_code);

}  // namespace pharos::tools
