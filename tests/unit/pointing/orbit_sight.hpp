// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::pointing {

/// A satellite on a circular orbit over a station, and the planes that a telescope would see of its axis.
struct OrbitSight {
  Geodetic station{34.27 * kRadPerDeg, 108.95 * kRadPerDeg, 400.0};
  double altitude_m = 500e3;
  double culmination_s = 1000.0;  // when the satellite is nearest
  double side_rad = 0.03;         // Earth's central angle between station and ground track at E's rotation stopped
  double heading_rad = 0.5;

  double radius_m() const { return kEarthRadius_m + altitude_m; }
  double rate_rad_s() const { return std::sqrt(kEarthGravity_m3_s2 / std::pow(radius_m(), 3)); }

  /// Place in I (E at culmination_s).
  Vector3 place_inertial(double time_s) const {
    const Matrix3 R = station_to_earth(station);
    const Vector3 up = station_place_earth_m(station).normalized();
    const Vector3 ahead = (R.col(0) * std::sin(heading_rad) + R.col(1) * std::cos(heading_rad)).normalized();
    const Vector3 beside = up.cross(ahead).normalized();
    const Vector3 over = (std::cos(side_rad) * up + std::sin(side_rad) * beside).normalized();
    const Vector3 flight = (ahead - ahead.dot(over) * over).normalized();
    const double angle = rate_rad_s() * (time_s - culmination_s);
    return radius_m() * (std::cos(angle) * over + std::sin(angle) * flight);
  }
  Vector3 normal_inertial() const {
    return place_inertial(culmination_s).cross(place_inertial(culmination_s + 10.0)).normalized();
  }

  Observation observation(double time_s, bool with_range) const {
    const Matrix3 R_E_I = earth_to_inertial(time_s - culmination_s).transpose();
    const Vector3 d =
        station_to_earth(station).transpose() * (R_E_I * place_inertial(time_s) - station_place_earth_m(station));
    return {
        time_s, {std::atan2(d.x(), d.y()), std::atan2(d.z(), std::hypot(d.x(), d.y()))}, with_range ? d.norm() : 0.0};
  }

  /// R_O_I: x along flight, y against the orbit's normal, z nadir.
  Matrix3 orbital(double time_s) const {
    const Vector3 down = -place_inertial(time_s).normalized(), h = normal_inertial();
    Matrix3 R;
    R.row(0) = h.cross(Vector3(-down)).transpose();
    R.row(1) = -h.transpose();
    R.row(2) = down.transpose();
    return R;
  }

  /// Two planes of an axis (in S at that time), each with an independent error of sigma about the line of sight.
  template <class Random>
  PassImage image(double time_s, const Vector3& axis_inertial, double sigma_rad, Random& random,
                  bool with_range) const {
    PassImage result;
    result.observation = observation(time_s, with_range);
    const Matrix3 R_S_I = station_to_earth(station).transpose() * earth_to_inertial(time_s - culmination_s).transpose();
    const Vector3 axis = R_S_I * axis_inertial, ahead = direction_station(result.observation.sight);
    std::normal_distribution<double> noise(0.0, sigma_rad);
    for (const double side : {-1.0, 1.0}) {
      // Panel edges 1 m either side of the line of sight.
      const Vector3 across = ahead.cross(axis).normalized();
      const Vector3 to_edge = (ahead + side * across / 700e3).normalized();
      Vector3 normal = to_edge.cross(axis).normalized();
      const Vector3 along = ahead.cross(normal).normalized();
      normal = (normal + noise(random) * along).normalized();
      result.planes_station.push_back({normal, sigma_rad * sigma_rad * along * along.transpose() +
                                                   1e-16 * (Matrix3::Identity() - normal * normal.transpose())});
    }
    return result;
  }
};

}  // namespace pharos::pointing
