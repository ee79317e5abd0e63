// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring_hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/base/units.hpp"
#include "pharos/ring2/refine.hpp"

namespace pharos::host {
namespace {

using ring2::CircleModel;
using ring2::CircleProblem;
using ring2::Contour;
using ring2::ContourSet;

// Error of a whole ellipse if some of its edge points belong to another edge: the width of a rim whose two edges were
// mixed.
constexpr double kLooseSystematic_px = 1.5;
// Tolerances as in circle_match, but for ellipses with such errors: half a degree becomes ten.
constexpr double kLooseTilt = 12.0 * kRadPerDeg;
constexpr double kLooseOffAxisPerRadius = 0.15;
constexpr double kLooseNozzlePerRing = 0.75;
constexpr double kLooseDistancePerRing = 3.0;
constexpr std::size_t kMaxHypotheses = 24;
// Hypotheses whose images are less than a pixel apart (a hundredth of a ring of 100 px) converge to the same edges.
constexpr double kSamePerRadius = 0.008, kSameTilt_rad = 0.012;

// Search range and scale by round, from the errors of ellipses down to those of edges.
constexpr std::array<EdgeSearch, 6> kRounds = {
    {{7.0, 3.0}, {6.0, 2.0}, {5.0, 1.3}, {4.0, 0.9}, {4.0, 0.7}, {4.0, 0.7}}};
constexpr std::size_t kFirstRounds = 3;
// Contours with a smaller visible fraction are not used.
constexpr double kMinSeen = 0.15;
// Nor is a nozzle's in the last rounds, if one image shows less of it: it follows other edges there.
constexpr double kMinSeenOfNozzle = 0.4;

// A contour with half of the evidence may consist of two circles' edges, those of a ring's front and foot: its error is
// a tenth of a pixel over the square of that fraction. As weights such errors would let the other contours carry the
// model away from its edges (0.15 deg instead of 0.07 on a rendered pair).
constexpr double kMinUndisturbed = 0.25;
Contour with_disturbance(const EdgeContour& edge) {
  const double clean = std::clamp(edge.evidence / edge.evidence_limit, kMinUndisturbed, 1.0);
  Contour contour = edge.contour;
  contour.information *= clean * clean * clean;  // one power of the variance is in the weights
  return contour;
}

CircleProblem problem_of(const ring2::Rig& rig, const ContourSet& contours, bool nozzle) {
  CircleProblem problem;
  problem.rig = rig;
  problem.contours = contours;
  problem.free.fill(true);
  problem.free[ring2::kDistance] = problem.free[ring2::kSecondRadius] = nozzle;
  return problem;
}

bool may_be_nozzle(const MatchedCircle& ring, const MatchedCircle& nozzle) {
  if (nozzle.radius_m > kLooseNozzlePerRing * ring.radius_m) return false;
  if (nozzle.normal.dot(ring.normal) < std::cos(kLooseTilt)) return false;
  const Vector3 between = nozzle.centre_m - ring.centre_m;
  const double along = between.dot(ring.normal);
  const double off = (between - along * ring.normal).norm();
  return off < kLooseOffAxisPerRadius * (ring.radius_m + std::abs(along)) &&
         std::abs(along) < kLooseDistancePerRing * ring.radius_m && along > kMinNozzleDistance * ring.radius_m;
}

std::optional<RingHypothesis> hypothesis_of(const ring2::Rig& rig, const ContourSet& contours) {
  const auto fit = ring2::solve_ring2(rig, contours);
  if (!fit) return std::nullopt;
  RingHypothesis hypothesis;
  hypothesis.contours = contours;
  hypothesis.has_nozzle = (fit->unobservable & ring2::kUnobservableNozzle) == 0;
  hypothesis.model = {fit->normal, fit->ring_centre_m, fit->ring_radius_m, fit->distance_m, fit->nozzle_radius_m};
  if (hypothesis.has_nozzle && !(fit->distance_m > kMinNozzleDistance * fit->ring_radius_m)) return std::nullopt;
  hypothesis.evidence = -0.5 * fit->chi2;  // for sorting only
  return hypothesis;
}

std::array<std::vector<Contour>, ring2::kViews> loosened(
    const std::array<std::vector<Contour>, ring2::kViews>& contours) {
  std::array<std::vector<Contour>, ring2::kViews> loose;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    for (const Contour& contour : contours[v]) {
      loose[v].push_back(ring2::contour_of(contour.ellipse, kLooseSystematic_px, 1.0));
    }
  }
  return loose;
}

std::vector<RingHypothesis> best_first(std::vector<RingHypothesis> hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const RingHypothesis& a, const RingHypothesis& b) {
    return a.has_nozzle != b.has_nozzle ? a.has_nozzle : a.evidence > b.evidence;
  });
  if (hypotheses.size() > kMaxHypotheses) hypotheses.resize(kMaxHypotheses);
  return hypotheses;
}

}  // namespace

std::vector<RingHypothesis> ring_hypotheses(const ring2::Rig& rig,
                                            const std::array<std::vector<Contour>, ring2::kViews>& contours) {
  const auto loose = loosened(contours);
  const std::vector<MatchedCircle> circles = matched_circles(rig, loose);
  std::vector<RingHypothesis> hypotheses;
  const auto add = [&](const MatchedCircle& ring, const MatchedCircle* nozzle) {
    ContourSet set;
    for (std::size_t v = 0; v < ring2::kViews; ++v) {
      set[v][0] = loose[v][ring.index[v]];
      if (nozzle != nullptr) set[v][1] = loose[v][nozzle->index[v]];
    }
    if (const auto hypothesis = hypothesis_of(rig, set)) hypotheses.push_back(*hypothesis);
  };
  for (const MatchedCircle& ring : circles) {
    add(ring, nullptr);
    for (const MatchedCircle& nozzle : circles) {
      if (may_be_nozzle(ring, nozzle)) add(ring, &nozzle);
    }
  }
  return best_first(std::move(hypotheses));
}

std::vector<RingHypothesis> three_ellipse_hypotheses(const ring2::Rig& rig,
                                                     const std::array<std::vector<Contour>, ring2::kViews>& contours) {
  const auto loose = loosened(contours);
  std::vector<RingHypothesis> hypotheses;
  for (const MatchedCircle& circle : matched_circles(rig, loose)) {
    for (std::size_t v = 0; v < ring2::kViews; ++v) {
      for (const Contour& lone : loose[v]) {
        // The pair is the ring and the single ellipse its nozzle, or vice versa.
        const bool nozzle = lone.ellipse.a_px < kLooseNozzlePerRing * loose[v][circle.index[v]].ellipse.a_px;
        const bool ring = loose[v][circle.index[v]].ellipse.a_px < kLooseNozzlePerRing * lone.ellipse.a_px;
        if (!nozzle && !ring) continue;
        ContourSet set;
        for (std::size_t w = 0; w < ring2::kViews; ++w) set[w][nozzle ? 0 : 1] = loose[w][circle.index[w]];
        set[v][nozzle ? 1 : 0] = lone;
        if (const auto hypothesis = hypothesis_of(rig, set)) hypotheses.push_back(*hypothesis);
      }
    }
  }
  return best_first(std::move(hypotheses));
}

bool follow_edges(const ring2::Rig& rig, const Ring2Images& images, double systematic_px, FollowRounds rounds,
                  RingHypothesis& hypothesis) {
  CircleModel& model = hypothesis.model;
  const std::size_t first = rounds == FollowRounds::kFirst ? 0 : kFirstRounds;
  const std::size_t end = rounds == FollowRounds::kFirst ? kFirstRounds : kRounds.size();
  for (std::size_t round = first; round < end; ++round) {
    const EdgeSearch& search = kRounds[round];
    ContourSet contours, cautious, stated;
    hypothesis.evidence = hypothesis.nozzle_evidence = 0.0;
    hypothesis.evidence_limit = {};
    hypothesis.edges = 0;
    const std::array<ExpectedCircle, ring2::kFeatures> circles{
        {{model.centre_m, model.normal, model.radius_m},
         {model.centre_m + model.distance_m * model.normal, model.normal, model.second_radius_m}}};
    for (std::size_t v = 0; v < ring2::kViews; ++v) {
      for (std::size_t f = 0; f < (hypothesis.has_nozzle ? 2U : 1U); ++f) {
        const auto edge = edge_contour(rig.views[v], images[v], circles[f], search, systematic_px);
        hypothesis.seen[v][f] = edge ? edge->seen : 0.0;
        if (!edge) continue;
        hypothesis.evidence += edge->evidence;
        hypothesis.edges += edge->edges;
        hypothesis.evidence_limit[f] += edge->evidence_limit;
        if (f == 1) hypothesis.nozzle_evidence += edge->evidence;
        if (!(edge->seen > (f == 1 && rounds == FollowRounds::kLast ? kMinSeenOfNozzle : kMinSeen))) continue;
        contours[v][f] = edge->contour;
        cautious[v][f] = with_disturbance(*edge);
        stated[v][f] = edge->contour;
        stated[v][f]->information = edge->stated_information;
      }
    }
    const CircleProblem problem = problem_of(rig, contours, hypothesis.has_nozzle);
    const auto refined = ring2::refine(problem, model, std::numeric_limits<double>::infinity());
    if (!refined) return false;
    hypothesis.contours = contours;
    hypothesis.cautious = cautious;
    hypothesis.stated = stated;
    model = refined->model;
  }
  return true;
}

bool is_same(const RingHypothesis& a, const RingHypothesis& b) {
  if (a.has_nozzle != b.has_nozzle) return false;
  const double ring_m = a.model.radius_m;
  const auto near = [&](double x, double y) { return std::abs(x - y) < kSamePerRadius * ring_m; };
  return (a.model.normal - b.model.normal).norm() < kSameTilt_rad && near(a.model.radius_m, b.model.radius_m) &&
         (a.model.centre_m - b.model.centre_m).norm() < 2.0 * kSamePerRadius * ring_m &&
         near(a.model.distance_m, b.model.distance_m) && near(a.model.second_radius_m, b.model.second_radius_m);
}

}  // namespace pharos::host
