// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/rig_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "board_truth.hpp"
#include "host/calibrate/camera/board_turns.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

const LeftFromRight kRig{rotation_exp({0.01, -0.12, 0.02}), {0.08, 0.002, 0.005}};

struct Pairs {
  std::vector<CameraFromBoard> left, right;
};

Pairs pairs_of(int count, const Board& board) {
  sim::BoardSheet sheet;
  sheet.columns = board.columns;
  sheet.rows = board.rows;
  Pairs pairs;
  pairs.left = sim::board_poses(sim::kPaperLens, sheet, count, 8);
  for (const CameraFromBoard& T : pairs.left) pairs.right.push_back(kRig.inverse() * T);
  return pairs;
}

TEST(BoardTurns, ATurnedLabellingIsATurnedPose) {
  for (const Board& board : {Board{}, Board{BoardKind::kDots, 7, 7, 0.02, 0.005}}) {
    const CameraFromBoard T = sim::board_at({}, {0.0, 0.0, 0.5}, {0.3, 0.2, 0.1});
    const FoundBoard found = observed(sim::kPaperLens, T, board, 0.0, 1);
    for (int turns = 0; turns < turns_of(board); ++turns) {
      const FoundBoard again = turned(found, board, turns);
      const CameraFromBoard T_turned = turned(T, board, turns);
      for (std::size_t i = 0; i < board.size(); ++i) {
        const Vector2 expected = true_centroid(sim::kPaperLens, T_turned, board, i);
        ASSERT_LT((again.points[i].pixel - expected).norm(), 1e-6) << "turn " << turns << ", point " << i;
      }
    }
  }
}

TEST(BoardTurns, FindsHowEachBoardIsTurnedInTheRightImage) {
  const Board board{BoardKind::kDots, 7, 7, 0.02, 0.005};
  Pairs pairs = pairs_of(8, board);
  std::vector<int> undo;
  for (std::size_t i = 0; i < pairs.right.size(); ++i) {
    const int turns = static_cast<int>(i) % 4;
    pairs.right[i] = turned(pairs.right[i], board, turns);
    undo.push_back((4 - turns) % 4);
  }
  EXPECT_EQ(matching_turns(pairs.left, pairs.right, board), undo);
}

TEST(RigCalibration, JointAdjustmentGivesTheRigWithinItsCovariance) {
  const Board board;
  const Pairs pairs = pairs_of(10, board);
  BundleData data{board, false, {{}, {}}};
  for (std::size_t i = 0; i < pairs.left.size(); ++i) {
    data.found[0].push_back(observed(sim::kPaperLens, pairs.left[i], board, 0.02, i));
    data.found[1].push_back(observed(sim::kPaperLens, pairs.right[i], board, 0.02, 100 + i));
  }
  BundleState start{{camera_of(sim::kPaperLens), camera_of(sim::kPaperLens)}, kRig, pairs.left};
  start.cameras[1].fx_px += 2.0;
  start.T_left_right.t.x() += 0.003;
  const auto outcome = adjust_boards(start, data);
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->parameters.size(), 24U);
  const Vector6 error = pose_difference(kRig, outcome->state.T_left_right);
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_LT(std::abs(error[i]), 3.5 * std::sqrt(outcome->covariance(18 + i, 18 + i)))
        << outcome->parameters[static_cast<std::size_t>(18 + i)];
  }
  EXPECT_LT(errors_of(*outcome, sim::kPaperLens, false).largest, 3.5);
  EXPECT_NEAR(outcome->noise_ratio, 1.0, 0.05);
}

TEST(RigCalibration, RenderedPairsGiveTheRigAndNameWhatWasNotUsed) {
  const sim::BoardSheet sheet;
  const sim::BoardRenderer renderer(sim::kPaperLens);
  sim::Exposure exposure;
  exposure.noise = 280.0;
  std::vector<host::GreyImage> images;
  for (const Vector3& tilt : {Vector3(0.5, 0.0, 0.0), Vector3(-0.3, 0.5, 0.0), Vector3(0.0, -0.5, 0.2)}) {
    const CameraFromBoard T = sim::board_at(sheet, {0.04, 0.01, 0.45}, tilt);
    images.push_back(renderer.render(sheet, T, exposure, images.size()));
    images.push_back(renderer.render(sheet, kRig.inverse() * T, exposure, images.size()));
  }
  std::vector<BoardPicture> left, right;
  for (std::size_t i = 0; i < images.size(); i += 2) {
    left.push_back({"left" + std::to_string(i), images[i].view()});
    right.push_back({"right" + std::to_string(i), images[i + 1].view()});
  }
  const std::vector<std::uint16_t> dark(640 * 480);
  left.push_back({"left_good", images[0].view()});
  right.push_back({"right_dark", {dark.data(), 640, 480}});
  const RigCalibration result = calibrate_rig(left, right, {{}, true});
  ASSERT_EQ(result.refusal, "");
  EXPECT_EQ(result.pairs, 3U);
  EXPECT_EQ(result.images[0][3].search.status, ImageStatus::kNoPartner);
  EXPECT_EQ(result.images[1][3].search.status, ImageStatus::kNoBoard);
  const Vector6 error = pose_difference(kRig, result.outcome->state.T_left_right);
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_LT(std::abs(error[i]), 3.5 * std::sqrt(result.outcome->covariance(16 + i, 16 + i)));
  }
  EXPECT_LT(result.epipolar_rms_px, 0.02);
}

TEST(RigCalibration, RefusesPairsWithoutBoards) {
  const std::vector<std::uint16_t> dark(64 * 48);
  const GreyView view(dark.data(), 64, 48);
  const RigCalibration result = calibrate_rig({{"a", view}}, {{"b", view}}, {});
  EXPECT_THAT(result.refusal, testing::HasSubstr("left camera: 0 of 1 images"));
}

}  // namespace
}  // namespace pharos::calibrate
