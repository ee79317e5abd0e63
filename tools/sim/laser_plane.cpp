// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/laser_plane.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

constexpr double kLean_rad = kPi / 6;

// The published series of a plane's bending by the angle along it, and its derivative.
struct Bend {
  double value = 0.0;
  double slope = 0.0;
};

Bend bend_at(double along_rad) {
  const double s = along_rad;
  const double a2 = 0.0076069798, a3 = 5.3685255e-06, a4 = 0.0028679863, a5 = -8.0108022e-06;
  return {a2 * s * s + a3 * s * s * s + a4 * s * s * s * s + a5 * s * s * s * s * s,
          2 * a2 * s + 3 * a3 * s * s + 4 * a4 * s * s * s + 5 * a5 * s * s * s * s};
}

}  // namespace

double turned_angle(std::size_t plane, const PlaneErrors& errors, const Vector3& point_L) {
  const double up = -point_L.y(), left = -point_L.x(), ahead = point_L.z();
  const double horizontal = std::hypot(left, ahead);
  const double lean = errors.tilt_rad + (plane == 0 ? kLean_rad : -kLean_rad);
  // Azimuth from the right-hand axis: a quarter turn is straight ahead.
  const double azimuth = std::atan2(left, ahead) + kPi / 2;
  // A plane that leans meets a point above the horizon later or earlier by an angle with this sine.
  const double sine = up / horizontal * std::tan(lean);
  const double along = std::asin(up / point_L.norm() / std::cos(lean));
  const double bending =
      errors.curve + errors.ogee_magnitude * std::sin(azimuth - std::asin(sine) + errors.ogee_phase_rad);
  const Bend bend = bend_at(along);
  const double bent =
      azimuth - std::asin(sine + bend.value * bending / (std::cos(lean) - bend.slope * bending * std::sin(lean)));
  const double uneven = errors.gibbous_magnitude_rad * std::sin(bent + errors.gibbous_phase_rad);
  const double straight_ahead = (plane == 0 ? 1.0 : 2.0) * kTwoPi / 3;
  return straight_ahead + bent - kPi / 2 + uneven - errors.phase_rad;
}

}  // namespace pharos::sim
