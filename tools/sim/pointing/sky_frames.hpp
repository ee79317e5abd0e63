// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"
#include "tools/sim/pointing/pointing_scenario.hpp"

namespace pharos::sim {

// The simulator's own frames: written apart from what is tested with them.

/// East, north, up in the Earth-fixed frame, as columns.
Matrix3 earth_from_station(const PointingStation& station);
Vector3 station_in_earth_m(const PointingStation& station);
/// Image right, image down, line of sight in the station's frame, as columns.
Matrix3 station_from_camera(double azimuth_rad, double elevation_rad);
/// Columns: an axis of pitch and yaw (paper 003, (1)), the panel's short side, its bright side's normal, which faces
/// the camera as far as the axis allows and is then turned about the axis by `roll_rad`.
Matrix3 station_from_body(const Vector3& axis, const Vector3& sight, double roll_rad);
Vector3 direction_of(double pitch_rad, double yaw_rad);

}  // namespace pharos::sim
