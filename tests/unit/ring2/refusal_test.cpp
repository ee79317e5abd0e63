// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/ring2/scenes.hpp"

namespace pharos::ring2 {
namespace {

TEST(Ring2Refusal, LeftAndRightExchangedIsSaid) {
  int said = 0;
  int all = 0;
  for (const Scene& scene : paper_scenes()) {
    const ContourSet contours = clean_contours(scene);
    const auto estimate = solve_ring2(core_rig(scene.rig), {contours[1], contours[0]});
    ASSERT_FALSE(estimate.ok());
    ++all;
    said += estimate.error() == Ring2Failure::kExchanged ? 1 : 0;
  }
  EXPECT_EQ(said, all);
}

TEST(Ring2Refusal, EllipsesOfAnotherRigAreInconsistent) {
  const Scene scene = scene_of(3.0 * kDeg, 4.0 * kDeg);
  const Scene other = scene_of(3.0 * kDeg, 4.0 * kDeg, 3.0, 1.8, 26.0 * kDeg);
  ContourSet contours = clean_contours(scene);
  contours[1] = clean_contours(other)[1];
  contours[1][0]->ellipse.cy_px += 40.0;
  contours[1][0]->centre_px.y() += 40.0;
  const auto estimate = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_FALSE(estimate.ok());
  EXPECT_EQ(estimate.error(), Ring2Failure::kInconsistent);
}

TEST(Ring2Refusal, ARingTakenForTheNozzleInOneViewIsInconsistent) {
  const Scene scene = scene_of(3.0 * kDeg, 4.0 * kDeg);
  ContourSet contours = clean_contours(scene);
  std::swap(contours[1][0], contours[1][1]);
  const auto estimate = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_FALSE(estimate.ok());
  EXPECT_EQ(estimate.error(), Ring2Failure::kInconsistent);
}

TEST(Ring2Refusal, ARigThatIsNoneIsNamed) {
  const Scene scene = scene_of(0.0, 0.0);
  const ContourSet contours = clean_contours(scene);
  Rig rig = core_rig(scene.rig);
  rig.views[1].T_rig_camera.t = rig.views[0].T_rig_camera.t;
  EXPECT_EQ(solve_ring2(rig, contours).error(), Ring2Failure::kCamerasCoincide);
  rig = core_rig(scene.rig);
  rig.views[0].T_rig_camera.R(0, 0) *= 1.01;
  EXPECT_EQ(solve_ring2(rig, contours).error(), Ring2Failure::kRigRotation);
  rig = core_rig(scene.rig);
  rig.views[0].T_rig_camera.R.col(0) *= -1.0;
  EXPECT_EQ(solve_ring2(rig, contours).error(), Ring2Failure::kRigRotation);
  rig = core_rig(scene.rig);
  rig.views[0].intrinsics.fx_px = 0.0;
  EXPECT_EQ(solve_ring2(rig, contours).error(), Ring2Failure::kRigIntrinsics);
}

TEST(Ring2Refusal, TooLittleToGoByIsNamed) {
  const Scene scene = scene_of(0.0, 0.0);
  ContourSet contours = clean_contours(scene);
  contours[0] = {};
  contours[1][1].reset();
  const auto one = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_FALSE(one.ok());
  EXPECT_EQ(one.error(), Ring2Failure::kTooFewEllipses);
  const auto none = solve_ring2(core_rig(scene.rig), {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error(), Ring2Failure::kTooFewEllipses);
}

TEST(Ring2Refusal, NoNumberGetsThrough) {
  const Scene scene = scene_of(2.0 * kDeg, 1.0 * kDeg);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0, -3.0}) {
    ContourSet contours = clean_contours(scene);
    contours[0][0] = contour_of(ellipse::Ellipse{600.0, 500.0, 100.0, bad, 0.1}, 0.1, 500.0);
    const auto estimate = solve_ring2(core_rig(scene.rig), contours);
    ASSERT_FALSE(estimate.ok());
    EXPECT_EQ(estimate.error(), Ring2Failure::kBadEllipse);
  }
}

}  // namespace
}  // namespace pharos::ring2
