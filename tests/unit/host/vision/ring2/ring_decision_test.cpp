// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "host/vision/ring2/ring2_detector.hpp"
#include "tests/unit/host/vision/ring2/rendered_pair.hpp"
#include "tools/sim/ring2/random_target.hpp"

namespace pharos::host {
namespace {

// Bodies of `pharos reproduce integrity --kind ring2`, by their seeds.
struct Seen {
  sim::RandomTarget target;
  Ring2Detection found;

  double error_deg() const { return angle_deg(found.estimate->normal, target.truth.normal); }
  double error_m() const { return (found.estimate->ring_centre_m - target.truth.ring_centre_m).norm(); }
};

Seen seen(std::uint64_t seed, const RingSizes& sizes = {}) {
  Seen result{sim::random_target(seed), {}};
  const std::array<GreyImage, 2> images{sim::image_of(result.target, 0, seed), sim::image_of(result.target, 1, seed)};
  Ring2Settings settings;
  settings.sizes = sizes;
  result.found = Ring2Detector(ring2::core_rig(result.target.rig), settings).find(views_of(images));
  return result;
}

void expect_right(const Seen& seen) {
  ASSERT_TRUE(seen.found.estimate.has_value()) << seen.found.refusal;
  EXPECT_FALSE(seen.found.estimate->ambiguous());
  EXPECT_LT(seen.error_deg(), 0.3);
  EXPECT_LT(seen.error_m(), 0.005);
}

// Covers and a boom hide a third of this ring: it may be refused.
TEST(RingDecision, TheEdgeOfARoundBodyIsNotTheRing) {
  const Seen hidden = seen(1);
  if (hidden.found.estimate) {
    expect_right(hidden);
  }
}

TEST(RingDecision, ARingBeforeARoundBodyIsNotANozzle) { expect_right(seen(20)); }

// Perspective moves the outer edge of a wide tilted rim aside of its inner one.
TEST(RingDecision, AWideRimIsAFaceNotAGrooveInIt) { expect_right(seen(2122)); }

// A boom and shadows cross it: one image has its outer edge only, the other one its inner edge, and both have a band
// inside it, 35 mm behind.
TEST(RingDecision, ARingOfWhichEachImageHasAnotherEdgeIsFound) { expect_right(seen(483006)); }

// Two bodies with a ring and a nozzle each; the docking ring's nozzle is no ellipse, and neither image has both of its
// edges.
TEST(RingDecision, ARingBesideAnotherWhoseNozzleIsNotSeenMakesThePairUnsure) {
  EXPECT_EQ(seen(485148).found.refusal, "ring_unsure");
}

TEST(RingDecision, SizesThatAreToldDecide) {
  RingSizes sizes;
  sizes.outer_radius = KnownLength{sim::random_target(20).truth.ring_radius_m, 0.003};
  expect_right(seen(20, sizes));
  sizes.outer_radius = KnownLength{0.8, 0.003};
  const Seen other = seen(20, sizes);
  EXPECT_FALSE(other.found.estimate.has_value());
  EXPECT_EQ(other.found.refusal, "ring_unsure");
}

}  // namespace
}  // namespace pharos::host
