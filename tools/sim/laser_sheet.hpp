// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// How one rotor's laser sheet departs from a plane through the rotor's axis that starts at the flash.
struct SheetErrors {
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve_rad = 0.0;
  double gibbous_phase_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;
};

/// The two published sets of signs of the sheet's errors.
enum class SheetForm { kForm1 = 1, kForm2 = 2 };

/// Direction of a rotor's rotation: kX from the station's +x axis over straight ahead (z), about -y; kY from +y over z,
/// about x.
enum class Rotor { kX = 0, kY = 1 };

/// One rotor's laser sheet as a surface in space: a plane, tilted against the rotor's axis and bent along it, on a
/// rotor whose speed varies once per turn. Station's frame L: x right, y down, z ahead.
///
/// With a the distance of a point along the sheet's motion from the rotor's axis, o that along the axis, m the
/// mechanical angle of the rotor and theta = 2 pi (time since the flash) / period:
///   the sheet of mechanical angle m is the plane n(m) . p = 0, n(m) = tangent(m) - slope axis
///   form 1: slope = tilt;      theta = g - G cos(gamma + g) + c w^2, g = m - phase
///   form 2: slope = tan(tilt); theta = m - phase + G sin(b + gamma) - c w^2
/// with w the angle of the point along the axis, b that along the sweep (from straight ahead), G and gamma the gibbous
/// magnitude and phase, c the curve.
class LaserSheet {
 public:
  LaserSheet(Rotor rotor, SheetForm form, const SheetErrors& errors);

  /// Sine of the angle by which `point_L` is ahead of the sheet (0: hit; positive: hit later) when the rotor has turned
  /// by `turn_rad` since its flash. The point must be in front of the station (z > 0).
  double lead(double turn_rad, const Vector3& point_L) const;

  /// theta of a sheet without errors at that point: start value of the search for the hit.
  double ideal_turn(const Vector3& point_L) const;

 private:
  double mechanical_angle(double turn_rad, double along_sweep, double along_axis, double ahead) const;

  Rotor rotor_;
  SheetForm form_;
  SheetErrors errors_;
  double slope_;
};

}  // namespace pharos::sim
