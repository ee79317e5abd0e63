// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pointing/sky_frames.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace pharos::sim {

Matrix3 earth_from_station(const PointingStation& station) {
  // Turn E's axes to the meridian, then to the vertical.
  const Eigen::AngleAxisd meridian(station.longitude_rad, Vector3::UnitZ());
  const Eigen::AngleAxisd vertical(-station.latitude_rad, Vector3::UnitY());
  const Matrix3 up_east_north = (meridian * vertical).toRotationMatrix();
  Matrix3 R;
  R << up_east_north.col(1), up_east_north.col(2), up_east_north.col(0);
  return R;
}

Vector3 station_in_earth_m(const PointingStation& station) {
  // WGS-84 by its two semi-axes.
  constexpr double kA = 6'378'137.0, kB = 6'356'752.314245179;
  const double c = std::cos(station.latitude_rad), s = std::sin(station.latitude_rad);
  const double n = kA * kA / std::hypot(kA * c, kB * s);
  const double out = (n + station.height_m) * c;
  return {out * std::cos(station.longitude_rad), out * std::sin(station.longitude_rad),
          (kB * kB / (kA * kA) * n + station.height_m) * s};
}

Matrix3 station_from_camera(double azimuth_rad, double elevation_rad) {
  const Vector3 ahead(std::cos(elevation_rad) * std::sin(azimuth_rad), std::cos(elevation_rad) * std::cos(azimuth_rad),
                      std::sin(elevation_rad));
  const Vector3 right(std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0);
  Matrix3 R;
  R << right, ahead.cross(right), ahead;
  return R;
}

Matrix3 station_from_body(const Vector3& axis, const Vector3& sight, double roll_rad) {
  const Vector3 facing = (-sight + sight.dot(axis) * axis).normalized();
  const Vector3 normal = Eigen::AngleAxisd(roll_rad, axis) * facing;
  Matrix3 R;
  R << axis, normal.cross(axis), normal;
  return R;
}

Vector3 direction_of(double pitch_rad, double yaw_rad) {
  return {std::cos(pitch_rad) * std::sin(yaw_rad), std::cos(pitch_rad) * std::cos(yaw_rad), std::sin(pitch_rad)};
}

}  // namespace pharos::sim
