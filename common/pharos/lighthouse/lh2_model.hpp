// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "pharos/base/units.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::lighthouse {

// Lighthouse 2.0: one rotor carries two laser planes, tilted by -30 deg (a) and +30 deg (b). The angle of a hit is that
// of the rotor since its sync, less 2/3 pi (a) or 4/3 pi (b): 0 where the plane stands straight ahead, growing to the
// station's left. Frame L: x right, y down, z ahead.
//
// Ideal: alpha = atan2(-x, z) + asin(-y tan(t) / r), r = hypot(x, z), t = -30 deg for a, +30 deg for b.
// With calibration (public model of libsurvive and of Crazyflie; h = -y, T = -t + tilt):
//   B = pi/2 + atan2(-x, z),  s = asin(h / (|p| cos T)),  c = curve + ogee_magnitude sin(B - asin(h tan T / r) +
//   ogee_phase) m(s) = f0 s^5 + f1 s^4 + f2 s^3 + f3 s^2, d = dm/ds, g = B - asin(h tan T / r + m c / (cos T - d c sin
//   T)),  alpha = g + gibbous_magnitude sin(g + gibbous_phase) - phase - pi/2

/// Planes of a station.
inline constexpr std::size_t kPlanes = 2;

/// Departure of one laser plane from the ideal one, as a station sends it over OOTX.
struct PlaneCalibration {
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve = 0.0;
  double gibbous_phase_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;
  double ogee_phase_rad = 0.0;
  double ogee_magnitude = 0.0;

  bool operator==(const PlaneCalibration&) const = default;
};

/// A station's identity and calibration. Equal id and equal planes mean the same calibration.
struct Lh2Calibration {
  std::uint32_t id = 0;
  std::array<PlaneCalibration, kPlanes> plane;

  bool operator==(const Lh2Calibration&) const = default;
};

namespace lh2 {

inline constexpr double kTilt_rad = kPi / 6;
// The maker's polynomial of curve and ogee, in the form in which public sources give it.
inline constexpr std::array<double, 6> kCurveSeries = {-8.0108022e-06, 0.0028679863, 5.3685255e-06,
                                                       0.0076069798,   0.0,          0.0};

template <class Scalar>
Scalar limited(const Scalar& sine) {
  if (sine > Scalar(1.0)) return Scalar(1.0);
  if (sine < Scalar(-1.0)) return Scalar(-1.0);
  return sine;
}

/// The angle of `plane` (0 = a, 1 = b) for a point of frame L; `field`: the plane's calibration in the order of
/// PlaneCalibration. For double, and for the dual numbers of an optimiser.
template <class Scalar>
Scalar angle(std::size_t plane, const std::array<Scalar, 7>& field, const Scalar& x, const Scalar& y, const Scalar& z) {
  using std::asin, std::atan2, std::cos, std::sin, std::sqrt, std::tan;
  const auto& [phase, tilt, curve, gibbous_phase, gibbous_magnitude, ogee_phase, ogee_magnitude] = field;
  const Scalar height = -y;
  const Scalar T = tilt + Scalar(plane == 0 ? kTilt_rad : -kTilt_rad);
  const Scalar cos_T = cos(T), sin_T = sin(T);
  const Scalar B = Scalar(kPi / 2) + atan2(-x, z);
  const Scalar square = x * x + z * z;
  const Scalar sine = limited(Scalar(height * sin_T / (cos_T * sqrt(square))));
  const Scalar c = curve + ogee_magnitude * sin(B - asin(sine) + ogee_phase);
  const Scalar s = asin(limited(Scalar(height / (cos_T * sqrt(square + y * y)))));
  Scalar m = Scalar(kCurveSeries[0]), d = Scalar(0.0);
  for (std::size_t i = 1; i < kCurveSeries.size(); ++i) {
    d = d * s + m;
    m = m * s + Scalar(kCurveSeries[i]);
  }
  const Scalar g = B - asin(limited(Scalar(sine + m * c / (cos_T - d * c * sin_T))));
  return g + gibbous_magnitude * sin(g + gibbous_phase) - phase - Scalar(kPi / 2);
}

}  // namespace lh2

/// The two angles of one direction, rad.
using PlaneAngles = std::array<double, kPlanes>;

/// Angle that `plane` of a station shows for a point ahead of it (z > 0, frame L; its length does not matter).
double lh2_angle(const PlaneCalibration& calibration, std::size_t plane, const Vector3& p_lighthouse);

/// The same without calibration, and its gradient by the point, rad/m.
struct IdealPlaneAngle {
  double angle_rad = 0.0;
  Vector3 gradient = Vector3::Zero();
};
IdealPlaneAngle ideal_lh2_angle(std::size_t plane, const Vector3& p_lighthouse);

/// Exact gradient of lh2_angle by the point, rad/m.
Vector3 lh2_gradient(const PlaneCalibration& calibration, std::size_t plane, const Vector3& p_lighthouse);

/// Unit direction (frame L, z > 0) at which a station shows both angles, to 1e-9 rad. Empty where there is none.
std::optional<Vector3> lh2_direction(const Lh2Calibration& calibration, const PlaneAngles& angles);

}  // namespace pharos::lighthouse
