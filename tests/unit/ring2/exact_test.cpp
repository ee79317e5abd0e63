// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/ring2/scenes.hpp"

namespace pharos::ring2 {
namespace {

void expect_truth(const Ring2Estimate& estimate, const sim::RingAndNozzle& truth, double angle_deg, double relative) {
  EXPECT_LT(angle_between(estimate.normal, truth.normal) / kDeg, angle_deg);
  EXPECT_NEAR(estimate.ring_radius_m / truth.ring_radius_m, 1.0, relative);
  EXPECT_NEAR(estimate.nozzle_radius_m / truth.nozzle_radius_m, 1.0, relative);
  EXPECT_NEAR(estimate.distance_m / truth.distance_m, 1.0, relative);
  EXPECT_LT((estimate.ring_centre_m - truth.ring_centre_m).norm(), relative * truth.ring_centre_m.norm());
}

TEST(Ring2Exact, FindTheTruthInAllScenesOfThePaperAndTo25Degrees) {
  for (const Scene& scene : paper_scenes()) {
    const auto estimate = solve_ring2(core_rig(scene.rig), clean_contours(scene));
    ASSERT_TRUE(estimate.ok()) << name_of(estimate.error());
    expect_truth(*estimate, scene.target, 1e-6, 1e-6);
    EXPECT_FALSE(estimate->ambiguous());
    EXPECT_EQ(estimate->unobservable, 0);
  }
}

TEST(Ring2Exact, ANozzleBehindTheRingHasANegativeDistance) {
  Scene scene = scene_of(4.0 * kDeg, -7.0 * kDeg);
  scene.target.distance_m = -0.2;
  const auto estimate = solve_ring2(core_rig(scene.rig), clean_contours(scene));
  ASSERT_TRUE(estimate.ok());
  expect_truth(*estimate, scene.target, 1e-6, 1e-6);
}

TEST(Ring2Exact, LensDistortionCostsNothing) {
  for (int k = 0; k < 12; ++k) {
    Scene scene = scene_of((2.0 * k - 12.0) * kDeg, (9.0 - 1.5 * k) * kDeg);
    for (sim::StereoCamera& camera : scene.rig) camera.distortion = {-0.20, 0.08, 0.002, -0.001, 0.01};
    const auto estimate = solve_ring2(core_rig(scene.rig), clean_contours(scene));
    ASSERT_TRUE(estimate.ok()) << name_of(estimate.error());
    // An ellipse of least distance is what distorted circles are said by; first-order projections leave this much.
    expect_truth(*estimate, scene.target, 1e-4, 1e-5);
  }
}

TEST(Ring2Exact, ARigTurnedAndMovedAnswersInItsOwnFrame) {
  Scene scene = scene_of(6.0 * kDeg, 11.0 * kDeg);
  const Matrix3 turn = rotation_exp({0.3, -0.8, 0.5});
  const Vector3 shift(1.0, -2.0, 0.7);
  for (sim::StereoCamera& camera : scene.rig) {
    camera.R_rig_camera = turn * camera.R_rig_camera;
    camera.t_rig_camera_m = turn * camera.t_rig_camera_m + shift;
  }
  scene.target.normal = turn * scene.target.normal;
  scene.target.ring_centre_m = turn * scene.target.ring_centre_m + shift;
  const auto estimate = solve_ring2(core_rig(scene.rig), clean_contours(scene));
  ASSERT_TRUE(estimate.ok());
  expect_truth(*estimate, scene.target, 1e-6, 1e-6);
}

TEST(Ring2Exact, AThousandTimesLargerWorldHasTheSameAttitude) {
  const Scene scene = scene_of(3.0 * kDeg, 5.0 * kDeg);
  const ContourSet contours = noisy_contours(scene, 0.3, 4);
  Rig rig = core_rig(scene.rig);
  const auto small = solve_ring2(rig, contours);
  for (RigView& view : rig.views) view.T_rig_camera.t *= 1000.0;
  const auto large = solve_ring2(rig, contours);
  ASSERT_TRUE(small.ok() && large.ok());
  EXPECT_LT(angle_between(small->normal, large->normal), 1e-9);
  EXPECT_NEAR(large->ring_radius_m, 1000.0 * small->ring_radius_m, 1e-6);
  EXPECT_NEAR(large->sigma_normal_rad(), small->sigma_normal_rad(), 1e-9);
}

TEST(Ring2Exact, AnglesAreThoseOfTheContract) {
  for (const Attitude& attitude : {Attitude{0.0, 0.0}, Attitude{0.3, -0.2}, Attitude{-0.4, 0.45}}) {
    const Vector3 expected = sim::facing_normal(attitude.theta_rad, attitude.gamma_rad);
    EXPECT_LT((normal_of(attitude) - expected).norm(), 1e-15);
    const Attitude back = attitude_of(expected);
    EXPECT_NEAR(back.theta_rad, attitude.theta_rad, 1e-15);
    EXPECT_NEAR(back.gamma_rad, attitude.gamma_rad, 1e-15);
  }
}

TEST(Ring2Exact, TakeNoHeapMemory) {
  const Scene scene = scene_of(8.0 * kDeg, -6.0 * kDeg);
  const ContourSet contours = clean_contours(scene);
  const Rig rig = core_rig(scene.rig);
  test::AllocationGuard guard;
  const auto estimate = solve_ring2(rig, contours);
  const auto exchanged = solve_ring2(rig, {contours[1], contours[0]});
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(estimate.ok());
  EXPECT_FALSE(exchanged.ok());
}

TEST(Ring2Exact, DerivativesAreThoseOfCentralDifferences) {
  Scene scene = scene_of(8.0 * kDeg, -6.0 * kDeg);
  for (sim::StereoCamera& camera : scene.rig) camera.distortion = {-0.1, 0.03, 0.001, -0.001, 0.0};
  const ContourSet contours = clean_contours(scene);
  const Rig rig = core_rig(scene.rig);
  const CircleModel model{scene.target.normal, scene.target.ring_centre_m, 0.56, 0.5, 0.1485};
  const Vector8 steps = (Vector8() << 1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5).finished();
  for (const Circle circle : {Circle::kFirst, Circle::kSecond}) {
    const Contour& contour = *contours[1][circle == Circle::kFirst ? 0 : 1];
    const auto here = shape_residual(model, circle, rig.views[1], contour);
    ASSERT_TRUE(here.has_value());
    for (int k = 0; k < kUnknowns; ++k) {
      const Vector8 step = steps[k] * Vector8::Unit(k);
      const auto more = shape_residual(moved(model, step), circle, rig.views[1], contour);
      const auto less = shape_residual(moved(model, -step), circle, rig.views[1], contour);
      const Vector5 difference = (more->value - less->value) / (2.0 * steps[k]);
      // Relative to the parameter's own size: px and px^2 stand side by side.
      for (int i = 0; i < 5; ++i) {
        const double scale = std::max(1.0, here->slope.row(i).cwiseAbs().maxCoeff());
        EXPECT_NEAR(here->slope(i, k) / scale, difference[i] / scale, 2e-3) << "unknown " << k << ", parameter " << i;
      }
    }
  }
}

}  // namespace
}  // namespace pharos::ring2
