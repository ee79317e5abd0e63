// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "host/cameras/rig_file.hpp"
#include "tools/sim/board/render_board.hpp"

namespace pharos::sim {

/// The sheet that board pairs show: 12 x 8 dots, 80 mm apart, 20 mm in radius.
inline constexpr BoardSheet kPairSheet{true, 12, 8, 0.08, 0.02, -1};

/// The board as both cameras of `rig` see it, held as in board_poses(), all of it in both images: DIR/left and
/// right/NN.png (8 bits, noise of one count), and rig.toml, the truth for `pharos calibrate stereo`. `step` is called
/// after every pair. Some 0.6 s a pair of 640x480.
void write_board_pairs(const host::RigFile& rig, int pairs, std::uint64_t seed, const std::string& directory,
                       const std::function<void()>& step);

}  // namespace pharos::sim
