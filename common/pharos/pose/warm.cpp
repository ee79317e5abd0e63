// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/warm.hpp"

#include <cmath>

#include "pharos/pose/covariance.hpp"
#include "pharos/pose/fixed_covariance.hpp"
#include "pharos/pose/minima.hpp"

namespace pharos::pose {
namespace {

using FixedMinima = Minima<FixedSystem>;

// With three sensors the prior decides between minima, and the words for what is missing are those of solve().
constexpr int kLeastSensors = 4;

bool credible(const FixedMinima& minima, int rows, double variance) {
  return minima.best.converged && minima.best.normal.cost <= credible_chi2(rows - kPoseUnknowns) * variance;
}

bool fill(const FixedSightings& sightings, const FixedMinima& minima, double variance, LighthousePoseEstimate& e) {
  Matrix6 unit;
  if (!fixed_unit_covariance(sightings, minima.best.pose, minima.best.normal, unit)) return false;
  e.pose = double_pose(sightings, minima.best.pose);
  e.covariance = unit * variance;
  e.adop_deg_per_rad = adop_of(unit);
  e.pdop_m_per_rad = pdop_of(unit);
  e.observations = sightings.rows;
  e.residual_rms = std::sqrt(minima.best.normal.cost / static_cast<double>(sightings.rows));
  e.iterations = minima.iterations;
  if (!minima.has_second) return true;
  const double delta = (minima.second.normal.cost - minima.best.normal.cost) / variance;
  if (delta < kAmbiguousDeltaChi2) e.second = {double_pose(sightings, minima.second.pose), delta};
  return true;
}

}  // namespace

std::optional<Solution> solve_warm(const Target& target, const Observations& observations, const SolveOptions& options,
                                   const LighthouseFromBody& prior) {
  if (options.residual != Residual::kAngle || options.rho != 0.0) return std::nullopt;
  FixedSightings sightings;
  if (!collect_fixed(target, observations, prior, sightings)) return std::nullopt;
  if (sightings.count < kLeastSensors || sightings.rows < kPoseUnknowns) return std::nullopt;
  const double variance = options.sigma_rad * options.sigma_rad;
  const FixedSystem system(sightings);
  FixedMinima minima;
  both_minima(system, fixed_pose(sightings, prior), options.max_iterations, variance, minima);
  minima.has_second = minima.has_second && options.look_for_second;
  if (minima.undecided || !credible(minima, sightings.rows, variance) || !system.ahead(minima.best.pose)) {
    return std::nullopt;
  }
  std::optional<Solution> solution(std::in_place);
  if (!fill(sightings, minima, variance, solution->estimate)) return std::nullopt;
  solution->used = sightings.used;
  return solution;
}

}  // namespace pharos::pose
