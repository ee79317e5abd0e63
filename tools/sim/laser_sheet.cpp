// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/laser_sheet.hpp"

#include <cmath>

namespace pharos::sim {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

// Mechanical angle since the sheet's zero g of a rotor whose even angle is `even`: even = g - magnitude cos(phase + g).
double uneven_turn(double even_rad, const SheetErrors& errors) {
  double g = even_rad;
  for (int step = 0; step < 4 && errors.gibbous_magnitude_rad != 0.0; ++step) {
    const double argument = errors.gibbous_phase_rad + g;
    const double error = g - errors.gibbous_magnitude_rad * std::cos(argument) - even_rad;
    g -= error / (1.0 + errors.gibbous_magnitude_rad * std::sin(argument));
    if (std::abs(error) < 1e-14) break;
  }
  return g;
}

}  // namespace

LaserSheet::LaserSheet(Rotor rotor, SheetForm form, const SheetErrors& errors)
    : rotor_(rotor),
      form_(form),
      errors_(errors),
      slope_(form == SheetForm::kForm1 ? errors.tilt_rad : std::tan(errors.tilt_rad)) {}

double LaserSheet::mechanical_angle(double turn_rad, double along_sweep, double along_axis, double ahead) const {
  const double axis_angle = errors_.curve_rad == 0.0 ? 0.0 : std::atan2(along_axis, ahead);
  const double bend = errors_.curve_rad * axis_angle * axis_angle;
  if (form_ == SheetForm::kForm1) return errors_.phase_rad + uneven_turn(turn_rad - bend, errors_);
  const double from_ahead = std::atan2(ahead, along_sweep) - kHalfPi;
  return turn_rad + errors_.phase_rad + bend -
         errors_.gibbous_magnitude_rad * std::sin(from_ahead + errors_.gibbous_phase_rad);
}

double LaserSheet::lead(double turn_rad, const Vector3& point_L) const {
  // The sweep runs from +along_sweep over straight ahead; the axis points so that along_sweep, ahead, axis are
  // right-handed: x, z, -y for one rotor and y, z, x for the other.
  const double along_sweep = rotor_ == Rotor::kX ? point_L.x() : point_L.y();
  const double along_axis = rotor_ == Rotor::kX ? -point_L.y() : point_L.x();
  const double ahead = point_L.z();
  const double m = mechanical_angle(turn_rad, along_sweep, along_axis, ahead);
  const double on_tangent = ahead * std::cos(m) - along_sweep * std::sin(m);
  return (on_tangent - slope_ * along_axis) / std::hypot(along_sweep, ahead);
}

double LaserSheet::ideal_turn(const Vector3& point_L) const {
  return std::atan2(point_L.z(), rotor_ == Rotor::kX ? point_L.x() : point_L.y());
}

}  // namespace pharos::sim
