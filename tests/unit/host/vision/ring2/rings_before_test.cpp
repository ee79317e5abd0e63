// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/rings_before.hpp"

#include <gtest/gtest.h>

#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"

namespace pharos::host {
namespace {

using Contours = std::array<std::vector<ring2::Contour>, ring2::kViews>;

// A groove behind its ring: 3 m away, tilted by a quarter of a radian.
const sim::SpaceCircle kGroove{{0.1, 0.05, 3.0}, Vector3(0.25, 0.0, -1.0).normalized(), 0.4};
constexpr double kExitDistance_m = 0.5, kExitRadius_m = 0.18;

sim::StereoRig cameras() { return sim::symmetric_rig(0.8, 0.0, 1000.0, 1280, 1024); }

sim::SpaceCircle on_axis(double ahead_m, double radius_m) {
  return {kGroove.centre_m + ahead_m * kGroove.normal, kGroove.normal, radius_m};
}

ring2::Contour image_of(std::size_t view, const sim::SpaceCircle& circle) {
  const auto e = sim::projected_ellipse(cameras()[view], circle);
  return ring2::contour_of(ring2::core_ellipse(*e), 0.1, 300.0);
}

std::vector<RingHypothesis> before_groove(const Contours& contours) {
  return rings_before(ring2::core_rig(cameras()), contours,
                      {kGroove.normal, kGroove.centre_m, kGroove.radius_m, kExitDistance_m, kExitRadius_m});
}

// Each image has another edge of it.
TEST(RingsBefore, AreTheCirclesAboutTheAxisOfOneImage) {
  const auto rings = before_groove({{{image_of(0, on_axis(0.035, 0.59))}, {image_of(1, on_axis(0.035, 0.53))}}});
  ASSERT_EQ(rings.size(), 2U);
  for (const RingHypothesis& ring : rings) {
    EXPECT_TRUE(ring.has_nozzle);
    EXPECT_NEAR((ring.model.centre_m - kGroove.centre_m).dot(kGroove.normal), 0.035, 1e-4);
    EXPECT_NEAR(ring.model.distance_m, kExitDistance_m - 0.035, 1e-4);
    EXPECT_EQ(ring.model.second_radius_m, kExitRadius_m);
  }
  EXPECT_NEAR(rings[0].model.radius_m, 0.59, 1e-4);
  EXPECT_NEAR(rings[1].model.radius_m, 0.53, 1e-4);
}

TEST(RingsBefore, WhatIsBehindOrInTheSamePlaneIsNone) {
  EXPECT_TRUE(before_groove({{{image_of(0, on_axis(-0.05, 0.6)), image_of(0, on_axis(0.0, 0.43))}, {}}}).empty());
}

TEST(RingsBefore, TheNozzleIsNone) {
  EXPECT_TRUE(before_groove({{{image_of(0, on_axis(kExitDistance_m, kExitRadius_m))}, {}}}).empty());
}

TEST(RingsBefore, ACircleAsideOfTheAxisIsNone) {
  sim::SpaceCircle aside = on_axis(0.035, 0.59);
  aside.centre_m.y() += 0.1;
  EXPECT_TRUE(before_groove({{{image_of(0, aside)}, {}}}).empty());
}

}  // namespace
}  // namespace pharos::host
