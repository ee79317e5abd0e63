// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/target.hpp"
#include "pharos/network/station.hpp"

namespace pharos::network {

// A station at `at` that looks at `to`; x right, y down, z ahead.
inline WorldFromStation looking(const Vector3& at, const Vector3& to) {
  const Vector3 ahead = (to - at).normalized();
  const Vector3 right = ahead.cross(Vector3::UnitZ()).normalized();
  Matrix3 R;
  R << right, ahead.cross(right), ahead;
  return {R, at};
}

// Four sensors, 30 x 15 mm.
inline Target deck() {
  Target target;
  std::uint8_t number = 0;
  for (const double x : {-0.015, 0.015}) {
    for (const double y : {0.0075, -0.0075}) target.push_back({number++, {x, y, 0.0}, Vector3::UnitZ()});
  }
  return target;
}

inline Stations two_stations(Generation generation) {
  Stations stations;
  for (std::uint8_t k = 0; k < 2; ++k) {
    Station station;
    station.number = k;
    station.generation = generation;
    station.T_world_station = looking(k == 0 ? Vector3(-2.5, 0, 3) : Vector3(0.4, -3.0, 3), Vector3(0, 0, 0.8));
    station.sigmas = StationSigmas{0.002, 0.001, 0.0003};
    stations.push_back(station);
  }
  return stations;
}

}  // namespace pharos::network
