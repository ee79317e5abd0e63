// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>

#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::test {

/// Statistics of the solver over a set of problems.
struct CampaignResult {
  PnpScore score;
  int failures_that_truth_fits_better = 0;  // a start at the truth would have found a better minimum
  double nees_per_freedom = 0.0;            // mean over all results that are not ambiguous
  double nees_all_per_freedom = 0.0;
  int nees_count = 0;
};

inline double chi2_of(const LighthousePoseEstimate& e, const pose::SolveOptions& options) {
  const double rms = e.residual_rms / options.sigma_rad;
  return rms * rms * e.observations;
}

inline CampaignResult run_campaign(const Target& target, const PnpSet& set, const pose::SolveOptions& options,
                                   int problems, std::uint64_t seed) {
  PnpGenerator generator(target, set, seed);
  CampaignResult result;
  for (int k = 0; k < problems; ++k) {
    const PnpProblem problem = generator.next();
    const auto solution = pose::solve(target, problem.observations, options);
    if (!solution.ok()) {
      result.score.add_refusal();
      continue;
    }
    const LighthousePoseEstimate& e = solution->estimate;
    const int failures_before = result.score.failures;
    result.score.add(problem, e.pose, e.ambiguous(), bound_of(target, problem, set.sigma_rad));
    if (result.score.failures > failures_before) {
      const auto from_truth = pose::solve(target, problem.observations, options, &problem.truth);
      result.failures_that_truth_fits_better +=
          from_truth.ok() && chi2_of(from_truth->estimate, options) < chi2_of(e, options) - 0.01 ? 1 : 0;
    }
    const double nees = nees_of(problem.truth, e) / 6.0;
    result.nees_all_per_freedom += nees / problems;
    if (e.ambiguous()) continue;
    result.nees_per_freedom += nees;
    ++result.nees_count;
  }
  result.nees_per_freedom /= result.nees_count;
  return result;
}

inline void print(const char* what, const CampaignResult& r) {
  std::printf(
      "%-34s problems %d refused %d failures %d (truth fits better: %d) ambiguous %d wrong unflagged %d\n"
      "%34s x CRB rotation %.4f position %.4f (of sums %.4f %.4f) NEES/dof %.4f (with ambiguous %.4f)\n",
      what, r.score.problems, r.score.refused, r.score.failures, r.failures_that_truth_fits_better, r.score.ambiguous,
      r.score.wrong_unflagged, "", r.score.rotation_over_bound(), r.score.position_over_bound(),
      r.score.rotation_rms_over_bound(), r.score.position_rms_over_bound(), r.nees_per_freedom, r.nees_all_per_freedom);
}

}  // namespace pharos::test
