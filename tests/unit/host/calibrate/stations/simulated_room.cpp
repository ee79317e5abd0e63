// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/host/calibrate/stations/simulated_room.hpp"

#include <cmath>
#include <random>

namespace pharos::calibrate {
namespace {

using network::Generation;
using network::WorldFromBody;
using network::WorldFromStation;

constexpr double kOwn_rad = 20e-6, kCommon_rad = 30e-6, kSweep_s = 1.0 / 120.0;

// A station at `at` that looks at `to`; x right, y down, z ahead.
WorldFromStation looking(const Vector3& at, const Vector3& to) {
  const Vector3 ahead = (to - at).normalized();
  const Vector3 right = ahead.cross(Vector3::UnitZ()).normalized();
  Matrix3 R;
  R << right, ahead.cross(right), ahead;
  return {R, at};
}

// Ideal planes: LH1 cot theta = x / z or y / z; LH2 a plane through the rotor's axis y, tilted by 30 deg.
double ideal_angle(Generation generation, std::size_t plane, const Vector3& p) {
  if (generation == Generation::kLighthouse1) return std::atan2(p.z(), plane == 0 ? p.x() : p.y());
  const double tangent = std::tan(plane == 0 ? -0.5235987755982988 : 0.5235987755982988);
  return std::atan2(-p.x(), p.z()) + std::asin(-p.y() * tangent / std::hypot(p.x(), p.z()));
}

// Where light from the direction `ray` (body frame) meets a sensor of a target in the plane z = 0.
Vector3 met_at(const Vector3& sensor_m, const Vector3& ray, double stretch) {
  const Vector3 across(ray.x(), ray.y(), 0.0);
  const double square = across.squaredNorm();
  return square < 1e-12 ? sensor_m : Vector3(sensor_m + stretch / (ray.z() * ray.z()) * across.dot(sensor_m) * across);
}

}  // namespace

WorldFromBody SimulatedRoom::body_at(double t, double moving) {
  const Vector3 turn(0.5 * std::sin(0.8 * t), 0.4 * std::cos(0.7 * t), 0.9 * std::sin(0.5 * t));
  const Vector3 place(0.8 * std::sin(0.9 * t), 0.7 * std::cos(0.6 * t), 0.4 * std::sin(1.1 * t));
  return {rotation_exp(moving * turn), Vector3(0.0, 0.0, 0.9) + moving * place};
}

NetworkLog SimulatedRoom::record(double seconds, double moving, std::uint32_t seed) const {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  NetworkLog log;
  log.name = "room";
  const int sweeps = static_cast<int>(seconds / kSweep_s);
  for (int k = 0; k < sweeps; ++k) {
    const auto plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
    const double common = kCommon_rad * gauss(random);
    for (const SensorPlacement& sensor : target) {
      const double time_s = k * kSweep_s + 0.002 + 1e-5 * sensor.sensor;
      const WorldFromStation& T = *truth[station].T_world_station;
      const WorldFromBody body = body_at(time_s, moving);
      const Vector3 met_m = met_at(sensor.position_m, body.inverse() * T.t, stretch_from_aside);
      const Vector3 p = T.R.transpose() * (body * met_m - T.t);
      const double angle =
          ideal_angle(generation, plane, p) - truth[station].plane[plane].phase_rad + common + kOwn_rad * gauss(random);
      log.hits.push_back({truth[station].number, plane, {time_s, sensor.sensor, angle}});
    }
  }
  return log;
}

SimulatedRoom simulated_room(Generation generation) {
  SimulatedRoom room;
  room.generation = generation;
  for (std::uint8_t k = 0; k < 2; ++k) {
    network::Station station;
    station.number = k;
    station.generation = generation;
    station.T_world_station = looking(k == 0 ? Vector3(-2.5, 0.0, 2.6) : Vector3(0.4, -2.8, 2.4), Vector3(0, 0, 0.8));
    station.plane[0].phase_rad = 0.0103 + 0.001 * k;
    station.plane[1].phase_rad = -0.0098 + 0.001 * k;
    room.truth.push_back(station);
  }
  std::uint8_t number = 0;
  for (const double x : {-0.015, 0.015}) {
    for (const double y : {0.0075, -0.0075}) room.target.push_back({number++, {x, y, 0.0}, Vector3::UnitZ()});
  }
  return room;
}

}  // namespace pharos::calibrate
