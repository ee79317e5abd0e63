// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {

/// Writes every frame of the simulator into `directory` (made if need be): NNNN_intensity.png and NNNN_depth.png, or
/// NNNN_abcy16.raw where the scenario asks for it; camera.toml; truth.csv. `written` is called after each frame.
/// Throws host::InputError when a file cannot be written.
void write_tof_frames(TofSimulator& simulator, const std::filesystem::path& directory,
                      const std::function<void()>& written);

}  // namespace pharos::sim
