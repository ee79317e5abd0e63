// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

TEST(SpreadOf, IsTheRootMeanSquareAboutTheMean) {
  // Two rotations 2 deg either side of a half turn, where rotation vectors are discontinuous, and positions 3 mm apart.
  const Matrix3 half_turn = rotation_exp({kPi, 0.0, 0.0});
  std::vector<LighthouseFromBody> poses;
  for (const double side : {-1.0, 1.0}) {
    poses.push_back({rotation_exp({2.0 * kRadPerDeg * side, 0, 0}) * half_turn, {0.0, 0.0, 2.0 + 1.5e-3 * side}});
  }
  const PoseSpread spread = spread_of(poses);
  EXPECT_NEAR(spread.rotation_deg, 2.0, 1e-9);
  EXPECT_NEAR(spread.position_mm, 1.5, 1e-9);
}

TEST(ErrorOf, IsAnAngleAndADistance) {
  const LighthouseFromBody truth{rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  const LighthouseFromBody estimate{rotation_exp({0, 0, 5.0 * kRadPerDeg}) * truth.R, {1.003, 2.004, 3}};
  EXPECT_NEAR(error_of(estimate, truth).rotation_deg, 5.0, 1e-9);
  EXPECT_NEAR(error_of(estimate, truth).position_mm, 5.0, 1e-9);
}

TEST(QuantileOf, PicksByRank) {
  EXPECT_EQ(median_of({5, 1, 3}), 3.0);
  EXPECT_EQ(quantile_of({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 0.9), 10.0);
  EXPECT_EQ(quantile_of({7}, 0.05), 7.0);
}

}  // namespace
}  // namespace pharos::tools
