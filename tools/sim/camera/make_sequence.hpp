// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "tools/sim/camera/frame_sequence.hpp"

namespace pharos::sim {

/// Renders the first `most` frames of a scenario of `pharos sim tof`, and writes the camera's file to `camera_file`
/// unless that is empty. `made` is called after each frame. Throws host::InputError.
FrameSequence sequence_of_scenario(const std::string& scenario, std::uint64_t seed, std::size_t maximum,
                                   const std::filesystem::path& camera_file, const std::function<void()>& made);

/// The first `most` frames of a directory as `pharos sim tof` writes it, with its camera.toml; true poses are not read.
/// Throws host::InputError.
FrameSequence sequence_of_directory(const std::string& directory, std::size_t maximum);

/// The first `most` images of one side (0 left, 1 right) of recorded pairs, as `pharos sim stereo` writes them, for a
/// grey camera. Throws host::InputError; also where they are not of one size.
FrameSequence sequence_of_pairs(const std::string& directory, std::size_t side, std::size_t maximum);

}  // namespace pharos::sim
