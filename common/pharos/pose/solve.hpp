// SPDX-License-Identifier: Apache-2.0
#pragma once

// Bearings of one cycle in, a pose with its uncertainty out.
#include <bitset>
#include <cstdint>

#include "pharos/base/result.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/pose/observation.hpp"

namespace pharos::pose {

/// Source of the start value.
enum class Start : std::uint8_t { kAuto, kP3p, kRpnp, kDlt, kHomography };
/// The minimised residual: the angles themselves (default), or the paper's tangent-plane residual (6) as printed.
enum class Residual : std::uint8_t { kAngle, kTangent };

struct SolveOptions {
  double sigma_rad = kPaperSigma_rad;  // noise of one bearing that covariance, precision factors and gates assume
  double rho = 0.0;                    // correlation between sensors of one rotor, (19)
  Start start = Start::kAuto;
  Residual residual = Residual::kAngle;
  int max_iterations = 50;  // about 4 are taken; straight on to a plane some need 30
  bool look_for_second = true;
  /// A fit whose chi-squared per degree of freedom (with sigma_rad) is above this is refused; outliers are dropped
  /// first.
  double max_reduced_chi2 = 1e4;
  /// For slow cores: a fit to all hits whose chi-squared is up to this many times the plausible one is accepted (its
  /// residual shows it), without a search among them.
  double chi2_threshold_factor = 1.0;
  /// Maximum start poses of the search among hits, where hits compete or contradict; if none of them fits all hits:
  /// kSearchLimit. A soft core spends some two million instructions on each.
  int max_search_starts = 1'000'000;
};

/// Why there is no pose.
enum class Refusal : std::uint8_t {
  kNone,
  kTooFewSensors,   // fewer than four sensors with bearings (three with a prior), or fewer than six angles
  kUnknownSensors,  // bearings of sensors that the target does not have
  kDegenerate,      // the sensors seen leave a degree of freedom unconstrained
  kNotConverged,
  kPoorFit,        // no rigid body fits the bearings, or too few of them confirm the one that does
  kBehindStation,  // the only fit lies behind the station
  kBadInput,       // a bearing outside (0, pi) or not finite
  kSearchLimit,    // hits compete or contradict, and the search limit was reached without a consistent pose
  kTooUncertain,   // the covariance exceeds the limits (motion::UncertaintyLimits)
  kUnconfirmed,    // begun, or contradicted, a moment ago: the next sweeps of both rotors must fit first
  kSuspectTarget,  // the target's data contradict themselves too often to trust those that fit
};
inline constexpr Refusal kLastRefusal = Refusal::kSuspectTarget;
/// Sensors required for a pose without a prior.
inline constexpr int kMinSensorsAlone = 4;

/// A pose and which observations it used (index as given).
struct Solution {
  LighthousePoseEstimate estimate;
  std::bitset<kMaxObservations> used;
};

/// Pose of a target from one cycle of ideal bearings of one station. See README of this room for the method.
/// `prior`: a pose to start from (the last one); with it three sensors suffice. Never needed otherwise.
Result<Solution, Refusal> solve(const Target& target, const Observations& observations, const SolveOptions& options,
                                const LighthouseFromBody* prior = nullptr);

/// The word after `refused_` in tables: too_few_sensors, …
const char* name_of(Refusal refusal);

}  // namespace pharos::pose
