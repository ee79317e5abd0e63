// SPDX-License-Identifier: Apache-2.0
// Circles on one axis: which of them is the docking ring.
#include "host/vision/ring2/ring_choice.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pharos::host {
namespace {

ring2::Rig two_cameras() {
  ring2::Rig rig;
  for (const std::size_t v : {0U, 1U}) {
    rig.views[v].intrinsics = {1280, 1024, 1000.0, 1000.0, 640.0, 512.0, {}};
    rig.views[v].T_rig_camera.t = {v == 0 ? -0.4 : 0.4, 0.0, 0.0};
  }
  return rig;
}

constexpr double kRadius_m = 0.32, kNozzle_m = 0.12, kNozzleEvidence = 700.0, kRingLimit = 1000.0;

// A ring `behind_m` a plane 2 m away, and a nozzle on its axis that stays where it is.
FollowedHypothesis ring_at(double behind_m, double ring_evidence, double sigma_m) {
  FollowedHypothesis f;
  ring2::Ring2Estimate& e = f.estimate;
  e.ring_centre_m = {0.0, 0.0, 2.0 + behind_m};
  e.distance_m = 0.12 + behind_m;
  e.nozzle_centre_m = e.ring_centre_m + e.distance_m * e.normal;
  e.ring_radius_m = kRadius_m;
  e.nozzle_radius_m = kNozzle_m;
  e.covariance.diagonal() << 4e-6, 4e-6, 1e-8, 1e-8, sigma_m * sigma_m, 1e-6, 1e-6, 1e-6;
  RingHypothesis& h = f.hypothesis;
  h.model = {e.normal, e.ring_centre_m, e.ring_radius_m, e.distance_m, e.nozzle_radius_m};
  h.has_nozzle = true;
  h.evidence = ring_evidence + kNozzleEvidence;
  h.nozzle_evidence = kNozzleEvidence;
  h.evidence_limit = {kRingLimit, kNozzleEvidence};
  h.seen = {{{0.9, 1.0}, {0.9, 1.0}}};
  f.rim_evidence = 400.0;
  return f;
}

RingDecision decision_of(const std::vector<FollowedHypothesis>& all) { return decide(two_cameras(), all, {}); }

TEST(RingChoice, AFrontRingWhoseSigmasHoldItsFootIsTheRingWhereItIsAsPlain) {
  const std::vector<FollowedHypothesis> all = {ring_at(0.011, 780.0, 0.0015), ring_at(0.002, 600.0, 0.009)};
  const RingDecision decision = decision_of(all);
  EXPECT_EQ(decision.best, &all[1]);
  EXPECT_EQ(decision.rival, nullptr);
}

TEST(RingChoice, AMixtureOfEdgesInFrontIsNotTheRing) {
  const std::vector<FollowedHypothesis> all = {ring_at(0.0, 780.0, 0.0015), ring_at(-0.009, 380.0, 0.03)};
  const RingDecision decision = decision_of(all);
  EXPECT_EQ(decision.best, &all[0]);
  EXPECT_EQ(decision.rival, nullptr);
}

// Its own place is hardly known, but it is no edge of the groove's face: whatever is mixed up, it is another ring.
TEST(RingChoice, AWiderRingInFrontWhoseSigmasHoldAGrooveMakesItAmbiguous) {
  const auto with_radius = [](FollowedHypothesis f, double radius_m) {
    f.estimate.ring_radius_m = f.hypothesis.model.radius_m = radius_m;
    return f;
  };
  std::vector<FollowedHypothesis> all = {ring_at(0.0, 780.0, 0.0015), with_radius(ring_at(-0.009, 380.0, 0.008), 0.4)};
  RingDecision decision = decision_of(all);
  EXPECT_EQ(decision.best, &all[0]);
  EXPECT_EQ(decision.rival, &all[1]);
  all[1] = with_radius(ring_at(-0.009, 380.0, 0.008), 0.36);  // its own face's other edge
  EXPECT_EQ(decision_of(all).rival, nullptr);
  all[1] = with_radius(ring_at(0.009, 380.0, 0.008), 0.4);  // behind it
  EXPECT_EQ(decision_of(all).rival, nullptr);
}

// Too disturbed to be the answer, and too plain not to be there.
TEST(RingChoice, ADisturbedRingInFrontMakesAGrooveAmbiguous) {
  const std::vector<FollowedHypothesis> all = {ring_at(0.045, 740.0, 0.003), ring_at(0.0, 310.0, 0.009)};
  const RingDecision decision = decision_of(all);
  EXPECT_EQ(decision.best, &all[0]);
  EXPECT_EQ(decision.rival, &all[1]);
}

TEST(RingChoice, WhatHasAlmostNoEvidenceInFrontIsNoRival) {
  const std::vector<FollowedHypothesis> all = {ring_at(0.045, 740.0, 0.003), ring_at(0.0, 60.0, 0.009)};
  EXPECT_EQ(decision_of(all).rival, nullptr);
}

TEST(RingChoice, ACircleInARimsDepthBeforeItsRingIsNoNozzle) {
  FollowedHypothesis f = ring_at(0.0, 780.0, 0.0015);
  EXPECT_NE(decision_of({f}).best, nullptr);
  f.hypothesis.model.distance_m = 0.06 * kRadius_m;
  EXPECT_EQ(decision_of({f}).best, nullptr);
}

FollowedHypothesis lone_ring_at(const Vector3& aside_m, double radius_m) {
  FollowedHypothesis f = ring_at(0.0, 600.0, 0.001);
  f.hypothesis.has_nozzle = false;
  f.hypothesis.evidence = 600.0;
  f.hypothesis.nozzle_evidence = 0.0;
  f.hypothesis.model.centre_m += aside_m;
  f.hypothesis.model.radius_m = radius_m;
  return f;
}

TEST(RingChoice, ARingWithAFaceBesideTheChosenOneMayBeTheDockingRing) {
  const FollowedHypothesis chosen = ring_at(0.0, 900.0, 0.001);
  EXPECT_TRUE(is_ring_beside(lone_ring_at({0.7, 0.0, 0.0}, kRadius_m), chosen));
  EXPECT_FALSE(is_ring_beside(lone_ring_at({0.0, 0.0, 0.7}, kRadius_m), chosen));        // on its axis
  EXPECT_FALSE(is_ring_beside(lone_ring_at({0.7, 0.0, 0.0}, 0.5 * kRadius_m), chosen));  // a thruster
  FollowedHypothesis cover = lone_ring_at({0.7, 0.0, 0.0}, kRadius_m);
  cover.rim_evidence = 0.0;
  EXPECT_FALSE(is_ring_beside(cover, chosen));
}

}  // namespace
}  // namespace pharos::host
