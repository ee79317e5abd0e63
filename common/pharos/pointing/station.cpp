// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/station.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {

Matrix3 station_to_earth(const Geodetic& station) {
  const double sin_l = std::sin(station.longitude_rad), cos_l = std::cos(station.longitude_rad);
  const double sin_b = std::sin(station.latitude_rad), cos_b = std::cos(station.latitude_rad);
  Matrix3 R;
  R << -sin_l, -sin_b * cos_l, cos_b * cos_l,  //
      cos_l, -sin_b * sin_l, cos_b * sin_l,    //
      0.0, cos_b, sin_b;
  return R;
}

Vector3 station_place_earth_m(const Geodetic& station) {
  constexpr double kEccentricity2 = kEarthFlattening * (2.0 - kEarthFlattening);
  const double sin_b = std::sin(station.latitude_rad), cos_b = std::cos(station.latitude_rad);
  const double normal_m = kEarthRadius_m / std::sqrt(1.0 - kEccentricity2 * sin_b * sin_b);
  const double out_m = (normal_m + station.height_m) * cos_b;
  return {out_m * std::cos(station.longitude_rad), out_m * std::sin(station.longitude_rad),
          (normal_m * (1.0 - kEccentricity2) + station.height_m) * sin_b};
}

Vector3 direction_station(const LineOfSight& sight) {
  const double cos_e = std::cos(sight.elevation_rad);
  return {cos_e * std::sin(sight.azimuth_rad), cos_e * std::cos(sight.azimuth_rad), std::sin(sight.elevation_rad)};
}

Matrix3 camera_to_station(const LineOfSight& sight) {
  const double sin_a = std::sin(sight.azimuth_rad), cos_a = std::cos(sight.azimuth_rad);
  const double sin_e = std::sin(sight.elevation_rad), cos_e = std::cos(sight.elevation_rad);
  Matrix3 R;
  R.col(0) << cos_a, -sin_a, 0.0;
  R.col(1) << sin_e * sin_a, sin_e * cos_a, -cos_e;
  R.col(2) = direction_station(sight);
  return R;
}

Vector3 signed_axis(const Vector3& axis) {
  const bool turn = axis.z() < 0.0 || (axis.z() == 0.0 && (axis.y() < 0.0 || (axis.y() == 0.0 && axis.x() < 0.0)));
  return turn ? Vector3(-axis) : axis;
}

PitchYaw pitch_yaw(const Vector3& axis) {
  return {std::asin(std::clamp(axis.z(), -1.0, 1.0)), std::atan2(axis.x(), axis.y())};
}

Vector3 axis_of(const PitchYaw& angles) {
  const double cos_a = std::cos(angles.pitch_rad);
  return {cos_a * std::sin(angles.yaw_rad), cos_a * std::cos(angles.yaw_rad), std::sin(angles.pitch_rad)};
}

Matrix3 earth_to_inertial(double seconds) {
  const double angle = kEarthRate_rad_s * seconds, c = std::cos(angle), s = std::sin(angle);
  Matrix3 R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

}  // namespace pharos::pointing
