// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/solve.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pose/covariance.hpp"
#include "pharos/pose/hits.hpp"
#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/refine.hpp"
#include "pharos/pose/reject.hpp"
#include "pharos/pose/second_minimum.hpp"
#include "pharos/pose/start.hpp"

namespace pharos::pose {
namespace {

constexpr int kLeastSensors = 4;
constexpr int kLeastSensorsWithPrior = 3;
// Two fits nearer than this (squared, in sigmas, by the first one's information) are one and the same minimum.
constexpr double kSameMinimum = 1.0;

struct Problem {
  explicit Problem(const SolveOptions& o) : options(o), variance(o.sigma_rad * o.sigma_rad) {}

  const SolveOptions& options;
  Hits hits;
  double variance;
  int iterations = 0;
};

RefineLimits limits_of(const Problem& problem) {
  return {problem.options.max_iterations, kConvergedShare * problem.variance, 1e300};
}

Fit refined(Problem& problem, const LighthouseFromBody& start, double hopeless_cost = 1e300) {
  RefineLimits limits = limits_of(problem);
  limits.hopeless_cost = hopeless_cost;
  const Fit fit = refine(problem.hits.sightings, start, problem.options.residual, limits);
  problem.iterations += fit.iterations;
  return fit;
}

bool ahead_of_station(const Sightings& sightings, const LighthouseFromBody& pose) {
  return (pose * sightings.body_centroid()).z() > 0.0;
}

bool same_minimum(const Fit& a, const Fit& b, double variance) {
  const Vector6 d = pose_difference(b.pose, a.pose);
  double square = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      square += d[static_cast<int>(i)] * a.normal.matrix(i, j) * d[static_cast<int>(j)];
    }
  }
  return square < kSameMinimum * variance;
}

// The start that fits best as it is.
const LighthouseFromBody& nearest(const Problem& problem, const StartPoses& starts) {
  std::size_t best = 0;
  double best_cost = 1e300;
  for (std::size_t k = 0; starts.size() > 1 && k < starts.size(); ++k) {
    const double cost = cost_of(problem.hits.sightings, starts[k], problem.options.residual);
    if (cost < best_cost) {
      best_cost = cost;
      best = k;
    }
  }
  return starts[best];
}

struct Minima {
  Fit best;
  Fit second;
  bool has_second = false;
};

int freedom_of(const Problem& problem) { return problem.hits.sightings.rows() - kPoseUnknowns; }

// The mirror image of the best minimum as its rival; the better of the two first.
void find_rival(Problem& problem, Minima& m) {
  const Sightings& sightings = problem.hits.sightings;
  m.second = refined(problem, mirrored_in_depth(sightings, m.best.pose),
                     m.best.normal.cost + kAmbiguousDeltaChi2 * problem.variance);
  const bool usable = m.second.converged && ahead_of_station(sightings, m.second.pose);
  m.has_second = usable && !same_minimum(m.best, m.second, problem.variance);
  if (!m.has_second) return;
  // Where there is nothing to contradict a pose (three sensors), the one that the start led to comes first.
  const bool second_is_better = freedom_of(problem) > 0 && m.second.normal.cost < m.best.normal.cost;
  const bool first_is_usable = m.best.converged && ahead_of_station(sightings, m.best.pose);
  if (second_is_better || !first_is_usable) std::swap(m.best, m.second);
  m.has_second = first_is_usable;
}

// Both minima of the rows that take part, from one start. The second is complete only where it matters: within
// kAmbiguousDeltaChi2 of the first.
Minima descend(Problem& problem, const LighthouseFromBody& start) {
  constexpr int kRounds = 3;
  Minima m;
  m.best = refined(problem, start);
  for (int round = 0; round < kRounds; ++round) {
    const double cost_before = m.best.normal.cost;
    find_rival(problem, m);
    // Where the start led to no valley of the pair, the better one's own mirror image is still to be seen.
    if (!(m.best.normal.cost + kAmbiguousDeltaChi2 * problem.variance < cost_before)) break;
  }
  m.has_second = m.has_second && problem.options.look_for_second;
  return m;
}

bool credible(const Problem& problem, const Fit& fit) {
  return fit.converged && fit.normal.cost <= credible_chi2(freedom_of(problem)) * problem.variance;
}

Refusal too_few(const Problem& problem, bool prior) {
  const int sensors = problem.hits.sightings.sensors();
  const int rows = problem.hits.sightings.rows();
  if (sensors >= (prior ? kLeastSensorsWithPrior : kLeastSensors) && rows >= kPoseUnknowns) return Refusal::kNone;
  return problem.hits.strangers ? Refusal::kUnknownSensors : Refusal::kTooFewSensors;
}

// Whether enough hits confirm a pose that contradicts some: with one or two hits more than unknowns, some wrong choice
// of hits fits by chance (four sensors, one true hit replaced by a reflection: 1 in 6; six, four replaced: 1 in 25),
// and each two hits more that are left out make as many more choices as one confirming hit rules out.
bool confirmed(const Problem& problem) {
  constexpr int kLeastFreedom = 3;
  const int left_out = problem.hits.places() - problem.hits.sightings.rows();
  return left_out == 0 || freedom_of(problem) >= std::max(kLeastFreedom, (left_out + 1) / 2);
}

Refusal verdict(const Problem& problem, const Fit& fit) {
  const int freedom = freedom_of(problem);
  if (!fit.pose.is_finite() || !std::isfinite(fit.normal.cost)) return Refusal::kNotConverged;
  if (fit.smallest_pivot_ratio < kDegeneratePivotRatio) return Refusal::kDegenerate;
  if (freedom > 0 && fit.normal.cost > problem.options.max_reduced_chi2 * problem.variance * freedom) {
    return Refusal::kPoorFit;
  }
  if (!fit.converged) return Refusal::kNotConverged;
  if (!ahead_of_station(problem.hits.sightings, fit.pose)) return Refusal::kBehindStation;
  return Refusal::kNone;
}

void mark_used(const Hits& hits, std::bitset<kMaxObservations>& used) {
  for (int i = 0; i < hits.sensors(); ++i) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (hits.at(i, axis).chosen != Hits::kNone) used[static_cast<std::size_t>(hits.at(i, axis).chosen)] = true;
    }
  }
}

Solution solution_of(const Problem& problem, const Minima& minima) {
  const SolveOptions& options = problem.options;
  const Sightings& sightings = problem.hits.sightings;
  Solution solution;
  LighthousePoseEstimate& e = solution.estimate;
  e.pose = minima.best.pose;
  e.pose.R = orthonormalised(e.pose.R);
  const Matrix6 unit = unit_covariance(sightings, minima.best.pose, options.residual, options.rho, minima.best.normal);
  e.covariance = unit * problem.variance;
  e.adop_deg_per_rad = adop_of(unit);
  e.pdop_m_per_rad = pdop_of(unit);
  e.observations = sightings.rows();
  e.residual_rms = std::sqrt(minima.best.normal.cost / static_cast<double>(e.observations));
  e.iterations = problem.iterations;
  if (minima.has_second) {
    const double delta = (minima.second.normal.cost - minima.best.normal.cost) / problem.variance;
    if (delta < kAmbiguousDeltaChi2) {
      e.second = {minima.second.pose, delta};
      e.second->pose.R = orthonormalised(e.second->pose.R);
    }
  }
  mark_used(problem.hits, solution.used);
  return solution;
}

}  // namespace

Result<Solution, Refusal> solve(const Target& target, const Observations& observations, const SolveOptions& options,
                                const LighthouseFromBody* prior) {
  Problem problem(options);
  if (!collect_hits(target, observations, problem.hits)) return Refusal::kBadInput;
  if (const Refusal refusal = too_few(problem, prior != nullptr); refusal != Refusal::kNone) return refusal;

  StartPoses starts;
  if (prior != nullptr) {
    starts.push_back(*prior);
  } else {
    starts = start_poses(problem.hits.sightings, options.start);
  }
  Minima minima;
  if (!starts.empty() && !problem.hits.several) minima = descend(problem, nearest(problem, starts));
  if (problem.hits.several || !credible(problem, minima.best)) {
    if (minima.best.converged && !starts.full()) starts.push_back(minima.best.pose);
    LighthouseFromBody start;
    if (!fit_rigid_body(problem.hits, starts, options, start)) return Refusal::kNotConverged;
    if (too_few(problem, prior != nullptr) != Refusal::kNone || !confirmed(problem)) return Refusal::kPoorFit;
    minima = descend(problem, start);
  }
  if (const Refusal refusal = verdict(problem, minima.best); refusal != Refusal::kNone) return refusal;
  return solution_of(problem, minima);
}

const char* name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kTooFewSensors:
      return "too_few_sensors";
    case Refusal::kUnknownSensors:
      return "unknown_sensors";
    case Refusal::kDegenerate:
      return "degenerate";
    case Refusal::kNotConverged:
      return "not_converged";
    case Refusal::kPoorFit:
      return "poor_fit";
    case Refusal::kBehindStation:
      return "behind_station";
    case Refusal::kBadInput:
      return "bad_input";
  }
  return "unknown";
}

}  // namespace pharos::pose
