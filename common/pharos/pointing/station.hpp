// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos::pointing {

// Frames: S station (east, north, up at the station's geodetic vertical), E Earth-fixed (WGS-84: x to the Greenwich
// meridian, z to the north pole), C camera (x right, y down, z along the optical axis).

/// Position of the station, on the WGS-84 ellipsoid.
struct Geodetic {
  double latitude_rad = 0.0;   ///< north positive
  double longitude_rad = 0.0;  ///< east positive
  double height_m = 0.0;       ///< above the ellipsoid
};

/// R_E_S: columns east, north, up in E (paper 003, (3)-(4), as restored in the README).
Matrix3 station_to_earth(const Geodetic& station);
/// The station's position in E, m (paper 003, (2)).
Vector3 station_place_earth_m(const Geodetic& station);

/// Direction of the telescope: azimuth clockwise from north, elevation above the horizon.
struct LineOfSight {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

/// Unit vector of the optical axis in S: (cos E sin A, cos E cos A, sin E).
Vector3 direction_station(const LineOfSight& sight);
/// R_S_C: columns image right, image down, optical axis in S; the transpose of the paper's R (8). The image is upright:
/// the horizon is level in it.
Matrix3 camera_to_station(const LineOfSight& sight);

/// An axis has no sign: the representative with z >= 0, if 0 with y >= 0, if 0 too with x >= 0.
Vector3 signed_axis(const Vector3& axis);

/// Paper 003, formula (1): L = (cos a sin b, cos a cos b, sin a).
struct PitchYaw {
  double pitch_rad = 0.0;  ///< elevation above the horizontal plane, [-pi/2, pi/2]
  double yaw_rad = 0.0;    ///< from +Y (north) towards +X (east), (-pi, pi]; 0 for a vertical axis
};
PitchYaw pitch_yaw(const Vector3& axis);
Vector3 axis_of(const PitchYaw& angles);

/// R_I_E after `seconds`: an inertial frame that coincides with E at 0 (mean sidereal rotation).
Matrix3 earth_to_inertial(double seconds);

/// rad/s of the Earth in inertial space (IERS, mean).
inline constexpr double kEarthRate_rad_s = 7.292115e-5;
/// m^3/s^2, Earth's gravity times mass (WGS-84).
inline constexpr double kEarthGravity_m3_s2 = 3.986004418e14;
/// WGS-84.
inline constexpr double kEarthRadius_m = 6'378'137.0;
inline constexpr double kEarthFlattening = 1.0 / 298.257223563;

}  // namespace pharos::pointing
