// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/warm.hpp"

#include <bit>

#include "pharos/base/units.hpp"
#include "pharos/pose/fixed_covariance.hpp"
#include "pharos/pose/minima.hpp"

namespace pharos::pose {
namespace {

using FixedMinima = Minima<FixedSystem>;

bool credible(const FixedMinima& minima, int rows, double variance) {
  return minima.best.converged() && minima.best.normal.cost <= chi2_threshold(rows - kPoseUnknowns) * variance;
}

// Square root of a positive number to a relative 2^-30: the soft-float one takes 800 instructions.
double root(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int exponent = static_cast<int>(bits >> 52U) - 1022;
  const int half = exponent >= 0 ? (exponent + 1) / 2 : exponent / 2;  // value = 4^half times [1/8, 1)
  const fixed::Root r = fixed::root_of(fixed::from_double(value, 60 - 2 * half));
  return fixed::to_double(r.root, 30 + r.binary_exponent - half);
}

bool fill(const FixedObservationTable& table, const FixedMinima& minima, double variance, LighthousePoseEstimate& e) {
  if (!fixed_unit_covariance(table, minima.best.state, minima.best.normal, e.covariance)) return false;
  e.adop_deg_per_rad = kDegPerRad * root(e.covariance.topLeftCorner<3, 3>().trace());
  e.pdop_m_per_rad = root(e.covariance.bottomRightCorner<3, 3>().trace());
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b <= a; ++b) e.covariance(a, b) = e.covariance(b, a) = e.covariance(a, b) * variance;
  }
  e.pose = double_pose(table, minima.best.state);
  e.observations = table.rows;
  if (minima.best.normal.cost > 0.0) {
    e.residual_rms = root(minima.best.normal.cost / static_cast<double>(table.rows));
  }
  e.iterations = minima.iterations;
  if (!minima.has_second) return true;
  const double delta = (minima.second.normal.cost - minima.best.normal.cost) / variance;
  if (delta < kAmbiguousDeltaChi2) e.second = {double_pose(table, minima.second.state), delta};
  return true;
}

}  // namespace

std::optional<Solution> solve_warm(const Target& target, const Observations& observations, const SolveOptions& options,
                                   const LighthouseFromBody& prior) {
  if (options.residual != Residual::kAngle || options.rho != 0.0) return std::nullopt;
  FixedObservationTable table;
  if (!collect_fixed(target, observations, prior, table)) return std::nullopt;
  // With three sensors the prior decides between minima, and the refusals are those of solve().
  if (table.count < kMinSensorsAlone || table.rows < kPoseUnknowns) return std::nullopt;
  const double variance = options.sigma_rad * options.sigma_rad;
  const FixedSystem system(table);
  FixedMinima minima;
  both_minima(system, fixed_pose(table, prior), options.max_iterations, variance, minima);
  minima.has_second = minima.has_second && options.look_for_second;
  if (minima.undecided || !credible(minima, table.rows, options.chi2_threshold_factor * variance) ||
      !system.ahead(minima.best.state)) {
    return std::nullopt;
  }
  std::optional<Solution> solution(std::in_place);
  if (!fill(table, minima, variance, solution->estimate)) return std::nullopt;
  solution->used = table.used;
  return solution;
}

}  // namespace pharos::pose
