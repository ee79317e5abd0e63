// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/filter.hpp"

namespace pharos::fusion {

/// A bound of the error of position and attitude that holds but for the stated risk.
struct ProtectionLevel {
  bool position_available = false;
  bool rotation_available = false;
  double position_m = 0.0;  // 0 where unavailable
  double rotation_rad = 0.0;
};

/// How many sigmas a bound takes: of the fault-free error, and of the solution without each source.
struct ProtectionFactors {
  double fault_free = 0.0;
  std::array<double, kMaxSources> without{};
};

/// Half of the risk is that of fault-free errors, half that of faults, equal parts for each source. One hour has
/// 3600 / correlation_time_s independent looks; a fault lasts to the hour's end. The norm of three errors of at most
/// sigma exceeds K sigma with the tail of chi-squared of three degrees of freedom at K^2.
ProtectionFactors protection_factors(const Settings& settings);

/// Largest standard deviation of any direction: of position, and of rotation.
struct LargestSigma {
  double rotation_rad = 0.0;
  double position_m = 0.0;
};
LargestSigma largest_sigma(const Matrix6& pose_covariance);

/// Widens `level` to |d| + K sigma of another solution, d its difference from the main one: the main solution's error
/// is the other's plus d, whatever the fault that the other solution does not hold (solution separation: Brown,
/// "Solution of the two-failure GPS RAIM problem under worst case bias conditions", Navigation 44 (1997); Blanch et
/// al., "Baseline advanced RAIM user algorithm", Navigation 62 (2015). They bound d by the detection threshold, before
/// the measurement; here d is known).
void widen(ProtectionLevel& level, const Filter& main, const Filter& other, double factor);

/// In no direction a variance of the difference of two solutions below this part of the wider one's is believed:
/// rounding, and gates that differ.
inline constexpr double kSeparationSlack = 0.02;

/// d^T (P_i - P)^-1 d: the squared difference of two solutions of which the first uses a part of the other's
/// measurements, in its own sigmas; chi-squared of three degrees of freedom without a fault (Blanch et al. 2015,
/// equation 10). `P_i`: the smaller set's covariance; `P`: that of all. Where the left out source tells next to nothing
/// of a direction P is the larger one as often as not; kSeparationSlack holds there.
double separation_chi2(const Vector3& d, const Matrix3& P_i, const Matrix3& P);

}  // namespace pharos::fusion
