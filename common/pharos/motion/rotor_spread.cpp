// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/rotor_spread.hpp"

#include <cmath>

namespace pharos::motion {

RotorTerms rotor_terms(Axis axis, const Vector3& p_lighthouse) {
  const double along = p_lighthouse[index_of(axis)], across = p_lighthouse[1 - index_of(axis)];
  const double ahead = p_lighthouse.z();
  const double from_axis = std::hypot(along, ahead);
  const double elevation_rad = std::atan2(across, ahead);
  RotorTerms terms;
  terms << 1.0, across / from_axis, elevation_rad * elevation_rad, along / from_axis, ahead / from_axis;
  return terms;
}

RotorTerms rotor_variances(const RotorSpread& spread) {
  const double quadrature = 0.5 * spread.gibbous_magnitude_rad * spread.gibbous_magnitude_rad;
  RotorTerms variances;
  variances << spread.phase_rad * spread.phase_rad, spread.tilt_rad * spread.tilt_rad,
      spread.curve_rad * spread.curve_rad, quadrature, quadrature;
  return variances;
}

}  // namespace pharos::motion
