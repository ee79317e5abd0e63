// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/board_rig.hpp"

#include <array>
#include <string>

#include "host/calibrate/camera/rig_calibration.hpp"
#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/board/board_poses.hpp"

namespace pharos::tools {
namespace {

constexpr int kBoards = 15;  // as printed; the board itself is not
constexpr int kCandidates = 400;

// Inner corners; large enough to fill both views where they overlap.
sim::BoardSheet sheet() {
  sim::BoardSheet board;
  board.dots = false;
  board.columns = 9;
  board.rows = 6;
  board.pitch_m = 0.2;
  return board;
}

using sim::lens_of;
using BoardPose = Pose<frame::Camera, frame::Board>;

// As seen by either camera; both see the whole board.
std::vector<std::array<BoardPose, 2>> poses_of(const host::RigFile& rig, std::uint64_t seed) {
  const Pose<frame::Camera, frame::Camera> T_right_left = rig.right.pose().inverse() * rig.left.pose();
  const sim::Lens left = lens_of(rig.left.intrinsics), right = lens_of(rig.right.intrinsics);
  std::vector<std::array<BoardPose, 2>> poses;
  for (const BoardPose& in_left : sim::board_poses(left, sheet(), kCandidates, seed)) {
    const BoardPose in_right = T_right_left * in_left;
    if (!sim::shows_all_of(right, sheet(), in_right)) continue;
    poses.push_back({in_left, in_right});
    if (poses.size() == kBoards) break;
  }
  return poses;
}

calibrate::RigCalibration calibrated(const host::RigFile& truth, std::uint64_t seed) {
  std::array<std::vector<host::GreyImage>, 2> images;
  const std::array<sim::BoardRenderer, 2> renderers{sim::BoardRenderer(lens_of(truth.left.intrinsics)),
                                                    sim::BoardRenderer(lens_of(truth.right.intrinsics))};
  sim::Exposure exposure;
  exposure.noise = 280.0;
  for (const auto& pose : poses_of(truth, seed)) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint64_t noise = 1000 * seed + 2 * images[side].size() + side;
      images[side].push_back(renderers[side].render(sheet(), pose[side], exposure, noise));
    }
  }
  std::array<std::vector<calibrate::BoardPicture>, 2> pictures;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const host::GreyImage& image : images[side]) {
      pictures[side].push_back({std::to_string(pictures[side].size()), image.view()});
    }
  }
  calibrate::CalibrationChoices choices;
  choices.board.kind = calibrate::BoardKind::kChessboard;
  choices.board.columns = sheet().columns;
  choices.board.rows = sheet().rows;
  choices.board.pitch_m = sheet().pitch_m;
  choices.fix_k3 = true;
  return calibrate::calibrate_rig(pictures[0], pictures[1], choices);
}

}  // namespace

BoardRig rig_from_boards(const host::RigFile& truth, std::uint64_t seed) {
  const calibrate::RigCalibration result = calibrated(truth, seed);
  if (!result.outcome) throw host::InputError("the cameras of paper 004 from 15 boards: " + result.refusal);
  const calibrate::BundleState& state = result.outcome->state;
  BoardRig board;
  board.rig.left.intrinsics = state.cameras[0];
  board.rig.right.intrinsics = state.cameras[1];
  const Quaternion q = state.T_left_right.quaternion();
  const Vector3& t = state.T_left_right.t;
  board.rig.right.rotation_wxyz = {q.w(), q.x(), q.y(), q.z()};
  board.rig.right.position_m = {t.x(), t.y(), t.z()};
  const double baseline_m = (truth.right.pose().t - truth.left.pose().t).norm();
  const std::string item = "section 3, calibration from 15 boards";
  const std::string pairs = std::to_string(result.pairs) + " pairs used";
  board.rows = {
      {item, "reprojection RMS", "px", "", result.outcome->rms_px, pairs},
      {item, "left fx less the true one", "px", "", state.cameras[0].fx_px - truth.left.intrinsics.fx_px, ""},
      {item, "baseline less the true one", "mm", "", kMmPerM * (t.norm() - baseline_m), ""},
  };
  return board;
}

}  // namespace pharos::tools
