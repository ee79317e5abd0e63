// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/ring2/scenes.hpp"

namespace pharos::ring2 {
namespace {

constexpr std::size_t kLeft = 0, kRight = 1, kRing = 0, kNozzle = 1;

TEST(Ring2Partial, AnyOneEllipseMayBeMissing) {
  const Scene scene = scene_of(5.0 * kDeg, -8.0 * kDeg);
  for (std::size_t view : {kLeft, kRight}) {
    for (std::size_t feature : {kRing, kNozzle}) {
      ContourSet contours = clean_contours(scene);
      contours[view][feature].reset();
      const auto estimate = solve_ring2(core_rig(scene.rig), contours);
      ASSERT_TRUE(estimate.ok()) << name_of(estimate.error());
      EXPECT_LT(angle_between(estimate->normal, scene.target.normal) / kDeg, 1e-6);
      EXPECT_NEAR(estimate->distance_m, 0.5, 1e-6);
      EXPECT_EQ(estimate->unobservable, 0);
      EXPECT_EQ(estimate->ellipses, 3);
    }
  }
}

TEST(Ring2Partial, WithoutANozzleItsRadiusAndDistanceAreUnobservable) {
  const Scene scene = scene_of(5.0 * kDeg, -8.0 * kDeg);
  ContourSet contours = clean_contours(scene);
  contours[kLeft][kNozzle].reset();
  contours[kRight][kNozzle].reset();
  const auto estimate = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_TRUE(estimate.ok());
  EXPECT_EQ(estimate->unobservable, kUnobservableNozzle);
  EXPECT_LT(angle_between(estimate->normal, scene.target.normal) / kDeg, 1e-6);
  EXPECT_NEAR(estimate->ring_radius_m, 0.56, 1e-7);
}

TEST(Ring2Partial, WithoutARingTheNozzleStillHasItsPlace) {
  const Scene scene = scene_of(5.0 * kDeg, -8.0 * kDeg);
  ContourSet contours = clean_contours(scene);
  contours[kLeft][kRing].reset();
  contours[kRight][kRing].reset();
  const auto estimate = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_TRUE(estimate.ok());
  EXPECT_EQ(estimate->unobservable, kUnobservableRing);
  EXPECT_NEAR(estimate->nozzle_radius_m, 0.1485, 1e-7);
  EXPECT_LT((estimate->nozzle_centre_m - scene.target.nozzle().centre_m).norm(), 1e-6);
}

TEST(Ring2Partial, OneCameraGivesTheAttitudeButNoLength) {
  const Scene scene = scene_of(5.0 * kDeg, -8.0 * kDeg);
  for (std::size_t view : {kLeft, kRight}) {
    ContourSet contours = clean_contours(scene);
    contours[1 - view] = {};
    const auto estimate = solve_ring2(core_rig(scene.rig), contours);
    ASSERT_TRUE(estimate.ok()) << name_of(estimate.error());
    EXPECT_EQ(estimate->unobservable, kUnobservableScale);
    EXPECT_LT(angle_between(estimate->normal, scene.target.normal) / kDeg, 1e-6);
    EXPECT_EQ(estimate->covariance(kRadius, kRadius), 0.0);
  }
}

// Two cameras side by side, far from a lone ring that faces them: the tilt's sign is hidden in the noise.
Scene facing_ring(double tilt_rad) { return scene_of(tilt_rad, 0.0, 3.0, 0.05, 0.0); }

TEST(Ring2Partial, ARingSeenFaceOnSaysHowBadlyItsTiltIsKnown) {
  int outside = 0;
  double min_sigma_deg = 90.0;
  double worst_deg = 0.0;
  constexpr int kCount = 200;
  for (int k = 0; k < kCount; ++k) {
    const Scene scene = facing_ring((k % 8) * 0.25 * kDeg);
    ContourSet contours = noisy_contours(scene, 0.3, static_cast<std::uint64_t>(k));
    contours[kLeft][kNozzle].reset();
    contours[kRight][kNozzle].reset();
    const auto estimate = solve_ring2(core_rig(scene.rig), contours);
    ASSERT_TRUE(estimate.ok());
    const double error = angle_between(estimate->normal, scene.target.normal);
    if (error > 3.0 * estimate->sigma_normal_rad()) ++outside;
    worst_deg = std::max(worst_deg, error / kDeg);
    min_sigma_deg = std::min(min_sigma_deg, estimate->sigma_normal_rad() / kDeg);
  }
  EXPECT_GT(worst_deg, 0.5);
  EXPECT_GT(min_sigma_deg, 0.3);
  EXPECT_LE(outside, 4) << "of " << kCount;
}

TEST(Ring2Partial, MirroredTiltsAreBothReported) {
  // Tilted far enough for two distinct minima, too little baseline to choose.
  Scene scene = scene_of(12.0 * kDeg, 0.0, 3.0, 0.01, 0.0);
  ContourSet contours = noisy_contours(scene, 0.5, 3);
  contours[kLeft][kNozzle].reset();
  contours[kRight][kNozzle].reset();
  contours[kLeft][kRing]->information /= 400.0;  // edges said to be worse by twenty
  contours[kRight][kRing]->information /= 400.0;
  const auto estimate = solve_ring2(core_rig(scene.rig), contours);
  ASSERT_TRUE(estimate.ok());
  ASSERT_TRUE(estimate->ambiguous());
  const double own = angle_between(estimate->normal, scene.target.normal);
  const double other = angle_between(estimate->second->normal, scene.target.normal);
  EXPECT_LT(std::min(own, other), 1.0 * kDeg);
  EXPECT_GT(std::max(own, other), 20.0 * kDeg);
  EXPECT_LT(estimate->second->delta_chi2, 9.21);
}

TEST(Ring2Partial, TheNozzleDecidesBetweenMirroredTilts) {
  const Scene scene = scene_of(12.0 * kDeg, 0.0, 3.0, 0.01, 0.0);
  const auto estimate = solve_ring2(core_rig(scene.rig), noisy_contours(scene, 0.5, 3));
  ASSERT_TRUE(estimate.ok());
  EXPECT_FALSE(estimate->ambiguous());
  EXPECT_LT(angle_between(estimate->normal, scene.target.normal), 1.0 * kDeg);
}

}  // namespace
}  // namespace pharos::ring2
