// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "pharos/base/axis.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::motion {

/// How far the parameters of a station's rotors lie from those that are assumed, 1 sigma: each rotor for itself, the
/// same for all its hits.
struct RotorSpread {
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;  // its phase may be any

  bool operator==(const RotorSpread&) const = default;
};

/// Of a station of unknown calibration that is taken for an ideal one: root mean squares of what the eight rotors of
/// the recordings' four stations (BEC08E38, C33B4DE1, F77E21F3, 0AA54F65) send of themselves, 46.4, 5.9, 3.9 and 10.3
/// mrad (`pharos decode --ootx` of `hmd_static` and `two_bodies_hmd`, columns phase0 to gibmag1).
inline constexpr RotorSpread kFactorySpread{46.4e-3, 5.9e-3, 3.9e-3, 10.3e-3};

/// A rotor's error as a sum of independent terms: phase, tilt, curve, and the gibbous term's two quadratures.
inline constexpr int kRotorTerms = 5;
using RotorTerms = Eigen::Matrix<double, kRotorTerms, 1>;

/// Derivatives of an ideal rotor's raw angle by the terms, for a point ahead of the station (lighthouse/station_model,
/// up to signs, which a variance does not see).
RotorTerms rotor_terms(Axis axis, const Vector3& p_lighthouse);
/// Variances of the terms.
RotorTerms rotor_variances(const RotorSpread& spread);

}  // namespace pharos::motion
