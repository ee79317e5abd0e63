// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "pharos/pose/hit_candidates.hpp"
#include "pharos/pose/p3p.hpp"
#include "pharos/pose/refine.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {

/// All minima found by a search from every triplet's P3P poses and sixty random attitudes, best first.
inline std::vector<Fit> exhaustive_minima(const Target& target, const test::PnpProblem& problem, double sigma_rad,
                                          test::PnpGenerator& random) {
  HitCandidates hits;
  std::vector<Fit> minima;
  if (!collect_hit_candidates(target, problem.observations, hits)) return minima;
  const double variance = sigma_rad * sigma_rad;
  const Vector3 centroid_body = hits.table.body_centroid();
  const auto descend = [&](const LighthouseFromBody& start) {
    const Fit fit = refine(hits.table, start, Residual::kAngle, {200, 1e-10 * variance, 1e300});
    if (!fit.converged() || !fit.state.is_finite() || (fit.state * centroid_body).z() < 0.0) return;
    for (const Fit& known : minima) {
      const bool same = rotation_angle_between(known.state.R, fit.state.R) < 2e-3 &&
                        (known.state.t - fit.state.t).norm() < 3e-3 * fit.state.t.norm();
      if (same) return;
    }
    minima.push_back(fit);
  };
  const RaySet rays = rays_of(hits.table);
  for (int a = 0; a < rays.count; ++a) {
    for (int b = a + 1; b < rays.count; ++b) {
      for (int c = b + 1; c < rays.count; ++c) {
        for (const LighthouseFromBody& start : p3p(rays, {a, b, c})) descend(start);
      }
    }
  }
  constexpr int kRandomAttitudes = 60;
  for (int k = 0; k < kRandomAttitudes; ++k) {
    LighthouseFromBody start = random.random_pose();
    start.t = problem.truth * centroid_body - start.R * centroid_body;
    descend(start);
  }
  std::sort(minima.begin(), minima.end(), [](const Fit& a, const Fit& b) { return a.normal.cost < b.normal.cost; });
  return minima;
}

/// How the solver's pair of minima compares with the exhaustive search.
struct MinimaScore {
  int problems = 0, ambiguous = 0, better_missed = 0, second_missed = 0, second_false = 0;
};

inline MinimaScore compare_minima(const Target& target, const test::PnpSet& set, int problems, std::uint64_t seed) {
  test::PnpGenerator generator(target, set, seed), random(target, set, seed + 1);
  SolveOptions options;
  options.sigma_rad = set.sigma_rad;
  const double variance = set.sigma_rad * set.sigma_rad;
  MinimaScore score;
  for (; score.problems < problems; ++score.problems) {
    const test::PnpProblem problem = generator.next();
    const auto solution = solve(target, problem.observations, options);
    const std::vector<Fit> minima = exhaustive_minima(target, problem, set.sigma_rad, random);
    if (!solution.ok() || minima.empty()) {
      ++score.better_missed;
      continue;
    }
    const LighthousePoseEstimate& e = solution->estimate;
    const double cost = e.residual_rms * e.residual_rms * e.observations;
    score.better_missed += minima[0].normal.cost < cost - 1e-3 * variance ? 1 : 0;
    const bool has_second =
        minima.size() > 1 && minima[1].normal.cost < minima[0].normal.cost + kAmbiguousDeltaChi2 * variance;
    score.ambiguous += has_second ? 1 : 0;
    score.second_missed += has_second && !e.ambiguous() ? 1 : 0;
    score.second_false += !has_second && e.ambiguous() ? 1 : 0;
  }
  return score;
}

}  // namespace pharos::pose
