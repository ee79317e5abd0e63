// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/solve.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pose/covariance.hpp"
#include "pharos/pose/hit_candidates.hpp"
#include "pharos/pose/minima.hpp"
#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/refine.hpp"
#include "pharos/pose/reject.hpp"
#include "pharos/pose/start.hpp"

namespace pharos::pose {
namespace {

constexpr int kMinSensorsWithPrior = 3;

struct Problem {
  explicit Problem(const SolveOptions& o) : options(o), variance(o.sigma_rad * o.sigma_rad) {}

  const SolveOptions& options;
  HitCandidates hits;
  double variance;
  int iterations = 0;
};

// The start that fits best without refinement.
const LighthouseFromBody& nearest(const Problem& problem, const StartPoses& starts) {
  std::size_t best = 0;
  double best_cost = 1e300;
  for (std::size_t k = 0; starts.size() > 1 && k < starts.size(); ++k) {
    const double cost = cost_of(problem.hits.table, starts[k], problem.options.residual);
    if (cost < best_cost) {
      best_cost = cost;
      best = k;
    }
  }
  return starts[best];
}

int freedom_of(const Problem& problem) { return problem.hits.table.rows() - kPoseUnknowns; }

// Both minima of the rows that take part, from one start.
void minima_from(Problem& problem, const LighthouseFromBody& start, Minima<DoubleSystem>& minima) {
  const DoubleSystem system(problem.hits.table, problem.options.residual);
  both_minima(system, start, problem.options.max_iterations, problem.variance, minima);
  minima.has_second = minima.has_second && problem.options.look_for_second;
  problem.iterations += minima.iterations;
}

bool credible(const Problem& problem, const Fit& fit) {
  return fit.converged() && fit.normal.cost <= problem.options.chi2_threshold_factor *
                                                   chi2_threshold(freedom_of(problem)) * problem.variance;
}

Refusal too_few(const Problem& problem, bool prior) {
  const int sensors = problem.hits.table.sensors();
  const int rows = problem.hits.table.rows();
  if (sensors >= (prior ? kMinSensorsWithPrior : kMinSensorsAlone) && rows >= kPoseUnknowns) return Refusal::kNone;
  return problem.hits.unknown_sensors ? Refusal::kUnknownSensors : Refusal::kTooFewSensors;
}

// One rotor's angles leave a shift along its axis unconstrained, whatever the search would try.
bool one_axis(const ObservationTable& table) {
  bool x = false;
  bool y = false;
  for (int i = 0; i < table.count; ++i) {
    x = x || table.seen(i, Axis::kX);
    y = y || table.seen(i, Axis::kY);
  }
  return !(x && y);
}

// Whether enough hits confirm a pose that contradicts some: with one or two hits more than unknowns, some wrong choice
// of hits fits by chance (four sensors, one true hit replaced by a reflection: 1 in 6; six, four replaced: 1 in 25),
// and each two more hits left out add as many choices as one confirming hit rules out.
bool confirmed(const Problem& problem) {
  constexpr int kMinFreedom = 3;
  const int left_out = problem.hits.places() - problem.hits.table.rows();
  return left_out == 0 || freedom_of(problem) >= std::max(kMinFreedom, (left_out + 1) / 2);
}

Refusal verdict(const Problem& problem, const Fit& fit) {
  const int freedom = freedom_of(problem);
  if (!fit.state.is_finite() || !std::isfinite(fit.normal.cost)) return Refusal::kNotConverged;
  if (fit.smallest_pivot_ratio < kDegeneratePivotRatio) return Refusal::kDegenerate;
  if (freedom > 0 && fit.normal.cost > problem.options.max_reduced_chi2 * problem.variance * freedom) {
    return Refusal::kPoorFit;
  }
  if (!fit.converged()) return Refusal::kNotConverged;
  if (!DoubleSystem(problem.hits.table, problem.options.residual).ahead(fit.state)) return Refusal::kBehindStation;
  return Refusal::kNone;
}

void mark_used(const HitCandidates& hits, std::bitset<kMaxObservations>& used) {
  for (int i = 0; i < hits.sensors(); ++i) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (hits.at(i, axis).chosen != HitCandidates::kNone)
        used[static_cast<std::size_t>(hits.at(i, axis).chosen)] = true;
    }
  }
}

// Functions that must not be inlined: their temporaries would stay on the stack during all calls.
[[gnu::noinline]] Solution solution_of(const Problem& problem, const Minima<DoubleSystem>& minima) {
  const SolveOptions& options = problem.options;
  const ObservationTable& table = problem.hits.table;
  Solution solution;
  LighthousePoseEstimate& e = solution.estimate;
  e.pose = minima.best.state;
  e.pose.R = orthonormalised(e.pose.R);
  const Matrix6 unit = unit_covariance(table, minima.best.state, options.residual, options.rho, minima.best.normal);
  e.covariance = unit * problem.variance;
  e.adop_deg_per_rad = adop_of(unit);
  e.pdop_m_per_rad = pdop_of(unit);
  e.observations = table.rows();
  e.residual_rms = std::sqrt(minima.best.normal.cost / static_cast<double>(e.observations));
  e.iterations = problem.iterations;
  if (minima.has_second) {
    const double delta = (minima.second.normal.cost - minima.best.normal.cost) / problem.variance;
    if (delta < kAmbiguousDeltaChi2) {
      e.second = {minima.second.state, delta};
      e.second->pose.R = orthonormalised(e.second->pose.R);
    }
  }
  mark_used(problem.hits, solution.used);
  return solution;
}

StartPoses only(const LighthouseFromBody& pose) {
  StartPoses starts;
  starts.push_back(pose);
  return starts;
}

// Both minima of the hits that belong to the body, or why there are none.
[[gnu::noinline]] Refusal find_minima(Problem& problem, const LighthouseFromBody* prior, Minima<DoubleSystem>& minima) {
  StartPoses starts = prior != nullptr ? only(*prior) : start_poses(problem.hits.table, problem.options.start);
  if (!starts.empty() && !problem.hits.has_multiple) minima_from(problem, nearest(problem, starts), minima);
  if (!problem.hits.has_multiple && credible(problem, minima.best)) return Refusal::kNone;
  if (minima.best.converged() && !starts.full()) starts.push_back(minima.best.state);
  LighthouseFromBody start;
  const Search search = fit_rigid_body(problem.hits, starts, problem.options, start);
  if (search == Search::kNoStart) return Refusal::kNotConverged;
  const Refusal short_of = search == Search::kCutShort ? Refusal::kSearchLimit : Refusal::kPoorFit;
  if (too_few(problem, prior != nullptr) != Refusal::kNone || !confirmed(problem)) return short_of;
  minima_from(problem, start, minima);
  if (search == Search::kCutShort && !credible(problem, minima.best)) return Refusal::kSearchLimit;
  return Refusal::kNone;
}

}  // namespace

Result<Solution, Refusal> solve(const Target& target, const Observations& observations, const SolveOptions& options,
                                const LighthouseFromBody* prior) {
  Problem problem(options);
  if (!collect_hit_candidates(target, observations, problem.hits)) return Refusal::kBadInput;
  if (const Refusal refusal = too_few(problem, prior != nullptr); refusal != Refusal::kNone) return refusal;
  if (one_axis(problem.hits.table)) return Refusal::kDegenerate;
  Minima<DoubleSystem> minima;
  if (const Refusal refusal = find_minima(problem, prior, minima); refusal != Refusal::kNone) return refusal;
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
    case Refusal::kSearchLimit:
      return "search_limit";
    case Refusal::kTooUncertain:
      return "too_uncertain";
    case Refusal::kUnconfirmed:
      return "unconfirmed";
    case Refusal::kSuspectTarget:
      return "suspect_target";
  }
  return "unknown";
}

}  // namespace pharos::pose
