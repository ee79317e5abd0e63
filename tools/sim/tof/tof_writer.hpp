// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {

/// camera.toml of the scenario's camera. Throws host::InputError when it cannot be written.
void write_tof_camera(const TofScenario& scenario, const std::filesystem::path& directory);

/// The files of one frame under a name of the caller's choice: NAME_intensity.png and NAME_depth.png, or
/// NAME_abcy16.raw. Throws host::InputError.
void write_tof_frame(TofSimulator& simulator, int frame, const std::string& name,
                     const std::filesystem::path& directory);

/// Writes every frame of the simulator into `directory` (made if need be): NNNN_intensity.png and NNNN_depth.png, or
/// NNNN_abcy16.raw where the scenario asks for it; camera.toml; truth.csv. `written` is called after each frame.
/// Throws host::InputError when a file cannot be written.
void write_tof_frames(TofSimulator& simulator, const std::filesystem::path& directory,
                      const std::function<void()>& written);

}  // namespace pharos::sim
