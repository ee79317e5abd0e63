// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/base/units.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {
namespace {

// Minimum log-likelihood ratio of a circle's edges against chance: a factor of 160,000, some hundred times the number
// of positions at which a circle of that size could be found.
constexpr double kMinEvidence = 12.0;
// Minimum fraction of a contour that has an edge, mean of both views. A contour that switches between the edges of rim,
// wall and shadow has about half of its points on one of them; of a true contour a third may be hidden or dark.
constexpr double kMinSeenOnAverage = 0.6;
constexpr double kMinSeenInOneView = 0.4;
constexpr double kMinSeenAlone = 0.75;
// Minimum evidence, as a fraction of that of undisturbed edges. A ring's contour is long and its rim is a lit face; a
// nozzle's lip is thin, and half of it is in front of a dark background.
constexpr double kMinCleanRing = 0.35, kMinCleanNozzle = 0.1;
// Minimum evidence of a second edge in the ring's plane, as a fraction of that of the undisturbed first one. The edge
// of a round body has chance edges beside it: up to a tenth; docking rings have from a fifth on.
constexpr double kMinRim = 0.15;
// A nozzle's exit is no farther before its ring than this, in radii of the ring: what stands before a small ring in one
// image only may be anything.
constexpr double kMaxNozzleDistance = 3.0;
// Two hypotheses closer than this are the same answer.
constexpr double kSameNormal_rad = 0.5 * kRadPerDeg;
constexpr double kSameCentre_m = 0.005;
// Two circles whose images are closer than this fraction of the larger radius share their edges.
constexpr double kOverPerRadius = 0.2;
// A docking ring is in front of the body: of circles on one axis the foremost is the ring, and those behind it are its
// foot, a groove or the body's edge. Fractions of the other circle's evidence: from kPlainRing on the foremost is the
// ring, from kFaintRing on it is ambiguous; below that it is noise.
constexpr double kPlainRing = 0.3, kFaintRing = 0.1;
// Of the other one's evidence, from which on a front circle is the ring though its own sigmas, those of a half dark
// contour, would hold the other as well.
constexpr double kAsPlainRing = 0.7;
// No ring's face is wider than this fraction of its radius: edges farther apart are of two rings.
constexpr double kMaxFaceWidth = 0.15;
// Another ring's radius is at least this fraction of the ring's, and its centre as far from the axis, in radii.
constexpr double kMinOtherRadius = 0.7, kMinOtherAside = 0.7;
// Maximum distance of the centres across the axis for circles on one axis, as a fraction of the radius.
constexpr double kAsidePerRadius = 0.01;
// A circle that differs from a known size by more than this number of sigmas is another one.
constexpr double kMaxSizeSigmas = 5.0;
// Distance between the two edges of a nozzle's lip, as a fraction of its radius: a known size may be that of either.
constexpr double kLipPerRadius = 0.15;

double mean_seen(const RingHypothesis& h, std::size_t feature) {
  return 0.5 * (h.seen[0][feature] + h.seen[1][feature]);
}

bool is_shown(const RingHypothesis& h, std::size_t feature, double evidence, double min_clean) {
  return evidence > kMinEvidence && evidence > min_clean * h.evidence_limit[feature];
}
// A ring may be absent in one view: its nozzle and the other view determine it. A contour that is present in part only
// follows other edges.
bool is_half_shown(double seen) { return seen > 0.0 && seen < kMinSeenInOneView; }
bool has_ring(const RingHypothesis& h) {
  return is_shown(h, 0, h.evidence - h.nozzle_evidence, kMinCleanRing) && mean_seen(h, 0) > kMinSeenOnAverage &&
         !is_half_shown(h.seen[0][0]) && !is_half_shown(h.seen[1][0]);
}
// One image that shows the nozzle is enough.
bool has_nozzle(const RingHypothesis& h) {
  const double max_seen = std::max(h.seen[0][1], h.seen[1][1]);
  return h.has_nozzle && (mean_seen(h, 1) > kMinSeenOnAverage || max_seen > kMinSeenAlone) &&
         is_shown(h, 1, h.nozzle_evidence, kMinCleanNozzle) &&
         h.model.distance_m > kMinNozzleDistance * h.model.radius_m &&
         h.model.distance_m < kMaxNozzleDistance * h.model.radius_m;
}

bool agrees(double found_m, double sigma_m, const KnownLength& told, double slack_m) {
  const double off = std::max(0.0, std::abs(found_m - told.value_m) - slack_m);
  return off < kMaxSizeSigmas * std::hypot(sigma_m, told.sigma_m);
}

// Whether the known sizes agree with this hypothesis.
bool agrees(const FollowedHypothesis& f, const RingSizes& sizes) {
  const ring2::Ring2Estimate& e = f.estimate;
  const auto sigma = [&](int unknown) { return std::sqrt(e.covariance(unknown, unknown)); };
  if (sizes.outer_radius || sizes.inner_radius) {
    const bool outer = sizes.outer_radius && agrees(e.ring_radius_m, sigma(ring2::kRadius), *sizes.outer_radius, 0.0);
    const bool inner = sizes.inner_radius && agrees(e.ring_radius_m, sigma(ring2::kRadius), *sizes.inner_radius, 0.0);
    if (!outer && !inner) return false;
  }
  if (!f.hypothesis.has_nozzle) return true;
  const double lip_m = kLipPerRadius * e.nozzle_radius_m;
  if (sizes.exit_radius && !agrees(e.nozzle_radius_m, sigma(ring2::kSecondRadius), *sizes.exit_radius, lip_m)) {
    return false;
  }
  return !sizes.distance || agrees(e.distance_m, sigma(ring2::kDistance), *sizes.distance, 0.0);
}

bool has_face(const FollowedHypothesis& f) {
  return f.rim_evidence > std::max(kMinEvidence, kMinRim * f.hypothesis.evidence_limit[0]);
}

bool is_candidate(const FollowedHypothesis& f, const RingSizes& sizes) {
  if (!has_ring(f.hypothesis) || !agrees(f, sizes)) return false;
  if (f.hypothesis.has_nozzle && !has_nozzle(f.hypothesis)) return false;
  if (sizes.outer_radius || sizes.inner_radius) return true;
  return f.hypothesis.has_nozzle && has_face(f);
}

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double centre_variance(const FollowedHypothesis& f) { return f.estimate.covariance.block<3, 3>(2, 2).trace(); }

bool is_same_answer(const FollowedHypothesis& a, const FollowedHypothesis& b) {
  const double sigma_rad = std::hypot(a.estimate.sigma_normal_rad(), b.estimate.sigma_normal_rad());
  return angle_between(a.estimate.normal, b.estimate.normal) < std::max(kSameNormal_rad, 3.0 * sigma_rad) &&
         (a.estimate.ring_centre_m - b.estimate.ring_centre_m).norm() <
             std::max(kSameCentre_m, 3.0 * std::sqrt(centre_variance(a) + centre_variance(b)));
}

// Whether the images of two circles coincide in one view.
bool is_over(const Vector3& from, const Vector3& a, double radius_a, const Vector3& b, double radius_b) {
  const double range_a = (a - from).norm(), range_b = (b - from).norm();
  const double size_a = radius_a / range_a, size_b = radius_b / range_b;
  const double apart = angle_between(a - from, b - from), larger = std::max(size_a, size_b);
  return apart < kOverPerRadius * larger && std::abs(size_a - size_b) < kOverPerRadius * larger;
}

// Whether a circle of one hypothesis coincides with a circle of the other in either image: both explain the same edges.
bool shares_edges(const ring2::Rig& rig, const ring2::Ring2Estimate& a, const ring2::Ring2Estimate& b) {
  return std::any_of(rig.views.begin(), rig.views.end(), [&](const ring2::RigView& view) {
    const Vector3& from = view.T_rig_camera.t;
    return is_over(from, a.ring_centre_m, a.ring_radius_m, b.ring_centre_m, b.ring_radius_m) ||
           is_over(from, a.nozzle_centre_m, a.nozzle_radius_m, b.nozzle_centre_m, b.nozzle_radius_m) ||
           is_over(from, a.nozzle_centre_m, a.nozzle_radius_m, b.ring_centre_m, b.ring_radius_m) ||
           is_over(from, a.ring_centre_m, a.ring_radius_m, b.nozzle_centre_m, b.nozzle_radius_m);
  });
}

// Whether both rings are on one axis, one behind the other: the edge of a round body behind its docking ring.
bool is_nested(const ring2::Ring2Estimate& a, const ring2::Ring2Estimate& b) {
  const double sigma_rad = 3.0 * std::hypot(a.sigma_normal_rad(), b.sigma_normal_rad());
  const Vector3 between = b.ring_centre_m - a.ring_centre_m;
  const Vector3 aside = between - between.dot(a.normal) * a.normal;
  const double slack_m = kAsidePerRadius * std::max(a.ring_radius_m, b.ring_radius_m) + sigma_rad * between.norm();
  return angle_between(a.normal, b.normal) < kSameNormal_rad + sigma_rad && aside.norm() < slack_m;
}

double ring_evidence(const FollowedHypothesis& f) { return f.hypothesis.evidence - f.hypothesis.nozzle_evidence; }

// Distance by which one ring is in front of the other on their axis.
double ahead_m(const FollowedHypothesis& f, const FollowedHypothesis& of) {
  return (f.estimate.ring_centre_m - of.estimate.ring_centre_m).dot(of.estimate.normal);
}

// Whether it is in front by more than the other one's own sigmas hold, however little is known of itself.
bool is_before(const FollowedHypothesis& f, const FollowedHypothesis& of) {
  return ahead_m(f, of) > std::max(kSameCentre_m, 3.0 * std::sqrt(centre_variance(of)));
}

// Whether it is another ring in front, of which too little is known to hold the other one's place: the answer would be
// that of a groove, known to a millimetre, in the face behind a ring that a boom and shadow disturb. Edges of one face
// may be mixed up instead, which says nothing of what is in front.
bool is_other_ring_before(const FollowedHypothesis& f, const FollowedHypothesis& of) {
  const double radius_m = f.estimate.ring_radius_m, of_m = of.estimate.ring_radius_m;
  return std::abs(radius_m - of_m) > kMaxFaceWidth * std::max(radius_m, of_m) && is_before(f, of) &&
         ring_evidence(f) > kPlainRing * ring_evidence(of) && is_nested(of.estimate, f.estimate);
}

// A ring that is no candidate, as too much of it is hidden or dark, may still stand in front of one that is: that is
// then its foot or a groove.
bool may_stand_before(const FollowedHypothesis& f, const FollowedHypothesis& best, const RingSizes& sizes) {
  return agrees(f, sizes) && mean_seen(f.hypothesis, 0) > kMinSeenOnAverage && f.rim_evidence > kMinEvidence &&
         ring_evidence(f) > std::max(kMinEvidence, kFaintRing * ring_evidence(best)) &&
         is_nested(best.estimate, f.estimate) && ahead_m(f, best) > 0.0 && !is_same_answer(f, best);
}

// Twice the log-likelihood ratio of the best hypothesis against one with another answer.
double delta_chi2(const ring2::Rig& rig, const FollowedHypothesis& best, const FollowedHypothesis& other) {
  const double by_edges = 2.0 * (best.hypothesis.evidence - other.hypothesis.evidence);
  if (is_nested(best.estimate, other.estimate)) {
    // Both circles may exist. A ring in front may be partly hidden or dark; a circle behind is not the ring.
    const bool may_be_ring = ahead_m(other, best) > 0.0 && ring_evidence(other) > kFaintRing * ring_evidence(best);
    return may_be_ring ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return shares_edges(rig, best.estimate, other.estimate) ? by_edges : 0.0;
}

}  // namespace

RingDecision decide(const ring2::Rig& rig, std::span<const FollowedHypothesis> followed, const RingSizes& sizes) {
  RingDecision decision;
  for (const FollowedHypothesis& f : followed) {
    if (!is_candidate(f, sizes)) continue;
    const bool better = decision.best == nullptr || (f.hypothesis.has_nozzle != decision.best->hypothesis.has_nozzle
                                                         ? f.hypothesis.has_nozzle
                                                         : f.hypothesis.evidence > decision.best->hypothesis.evidence);
    if (better) decision.best = &f;
  }
  if (decision.best == nullptr) return decision;
  const FollowedHypothesis* foremost = decision.best;
  for (const FollowedHypothesis& f : followed) {
    if (!is_candidate(f, sizes) || f.hypothesis.has_nozzle != foremost->hypothesis.has_nozzle) continue;
    if (!is_nested(decision.best->estimate, f.estimate)) continue;
    const double plain = ring_evidence(f) / ring_evidence(*decision.best);
    const bool is_other = ahead_m(f, *foremost) > 0.0 && !is_same_answer(f, *foremost);
    if ((plain > kPlainRing && is_other) || (plain > kAsPlainRing && is_before(f, *foremost))) foremost = &f;
  }
  decision.best = foremost;
  double least = kAmbiguousDeltaChi2;
  for (const FollowedHypothesis& f : followed) {
    if (f.hypothesis.has_nozzle != decision.best->hypothesis.has_nozzle) continue;
    const bool is_rival = is_candidate(f, sizes)
                              ? !is_same_answer(f, *decision.best) || is_other_ring_before(f, *decision.best)
                              : may_stand_before(f, *decision.best, sizes);
    if (!is_rival) continue;
    const double delta = std::max(0.0, delta_chi2(rig, *decision.best, f));
    if (delta >= least) continue;
    least = delta;
    decision.rival = &f;
    decision.delta_chi2 = delta;
  }
  return decision;
}

bool may_be_ring_beside(const ring2::CircleModel& other, const ring2::CircleModel& ring) {
  const Vector3 between = other.centre_m - ring.centre_m;
  const double aside_m = (between - between.dot(ring.normal) * ring.normal).norm();
  return other.radius_m > kMinOtherRadius * ring.radius_m &&
         aside_m > kMinOtherAside * std::max(other.radius_m, ring.radius_m);
}

bool is_ring_beside(const FollowedHypothesis& other, const FollowedHypothesis& ring) {
  return may_be_ring_beside(other.hypothesis.model, ring.hypothesis.model) && has_ring(other.hypothesis) &&
         has_face(other);
}

}  // namespace pharos::host
