// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/board_pairs.hpp"

#include <array>

#include "host/support/input_error.hpp"
#include "tools/sim/board/board_poses.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/stereo_tumbling/sequence_files.hpp"

namespace pharos::sim {
namespace {

constexpr int kTries = 100;  // poses for the left camera, for each that the right one sees too

Exposure exposure() {
  Exposure light;
  light.dark = 20.0;
  light.bright = 200.0;
  light.surround = 10.0;
  light.noise = 1.0;
  light.bits = 8;
  return light;
}

}  // namespace

void write_board_pairs(const host::RigFile& rig, int pairs, std::uint64_t seed, const std::string& directory,
                       const std::function<void()>& step) {
  const std::array<Lens, 2> lenses{lens_of(rig.left.intrinsics), lens_of(rig.right.intrinsics)};
  const std::array<BoardRenderer, 2> renderers{BoardRenderer(lenses[0]), BoardRenderer(lenses[1])};
  const auto T_right_left = rig.right.pose().inverse() * rig.left.pose();
  SequenceFiles files(directory, rig);
  int made = 0;
  for (const auto& T_left_board : board_poses(lenses[0], kPairSheet, kTries * pairs, seed)) {
    const std::array<Pose<frame::Camera, frame::Board>, 2> T{T_left_board, T_right_left * T_left_board};
    if (!shows_all_of(lenses[1], kPairSheet, T[1])) continue;
    const std::string stem = padded_number(static_cast<std::size_t>(made), 2);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint64_t noise = seed + 2 * static_cast<std::uint64_t>(made) + side;
      files.image(stem, static_cast<int>(side), renderers[side].render(kPairSheet, T[side], exposure(), noise));
    }
    step();
    if (++made == pairs) return;
  }
  throw host::InputError("no board can be held so that both cameras see all of it");
}

}  // namespace pharos::sim
