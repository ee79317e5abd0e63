// SPDX-License-Identifier: Apache-2.0
// What stands beside a panel's edges all along them.
#include <gtest/gtest.h>

#include "host/vision/pointing/measure_panel.hpp"
#include "support/painted_panel.hpp"

namespace pharos::pointing {
namespace {

using testing::PaintedPanel;

// A panel with a strip along its border that is as wide as the blur, and its sigma over that of one without.
struct RimmedPanel {
  PointingResult answer;
  double widened = 0.0, error_rad = 0.0;
};
RimmedPanel measure_rimmed(double out_rad, double range_m) {
  PaintedPanel plain;
  plain.camera.fx_px = plain.camera.fy_px = 30.0 * range_m;
  plain.range_m = range_m;
  plain.set_axis(0.3, out_rad);
  PaintedPanel rimmed = plain;
  rimmed.rim_m = 0.06;  // 1.8 px
  rimmed.rim_light = 0.6;
  const auto without = measure_panel(plain.image().view(), plain.camera);
  const auto with = measure_panel(rimmed.image().view(), rimmed.camera);
  EXPECT_TRUE(without.ok() && with.ok());
  RimmedPanel result;
  if (!without || !with) return result;
  result.answer = answer_of(*with, rimmed.sight, Tone::kLinear);
  result.widened = result.answer.axis.sigma_rad() / answer_of(*without, plain.sight, Tone::kLinear).axis.sigma_rad();
  const Vector3& axis = result.answer.axis.axis;
  result.error_rad = std::atan2(axis.cross(rimmed.axis_station).norm(), std::abs(axis.dot(rimmed.axis_station)));
  return result;
}

// It moves edges unlike where it is nearer; its error is stated.
TEST(MeasurePanel, WhatStandsBesideAnEdgeWidensItsSigma) {
  const RimmedPanel near = measure_rimmed(0.8, 20.0);
  EXPECT_GT(near.widened, 2.0);
  EXPECT_LT(near.error_rad, 4.0 * near.answer.axis.sigma_rad());
}

// All of an edge that is equally far moves alike, which does not turn it: no error is stated where there is none.
TEST(MeasurePanel, WhatStandsBesideAnEdgeOfOneDepthTurnsNoAxis) {
  const RimmedPanel level = measure_rimmed(0.05, 100.0);
  EXPECT_LT(level.widened, 1.5);
  EXPECT_LT(level.error_rad, 3.0 * level.answer.axis.sigma_rad());
}

}  // namespace
}  // namespace pharos::pointing
