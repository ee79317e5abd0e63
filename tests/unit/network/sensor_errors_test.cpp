// SPDX-License-Identifier: Apache-2.0
// What a target's sensors are: their places are not exact, and they see to one side.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/network/linearised_sweep.hpp"
#include "pharos/network/network_tracker.hpp"
#include "unit/network/room.hpp"

namespace pharos::network {
namespace {

// The mirrored attitude of a flat target may have a station behind it: its light is not taken for the body's then.
TEST(LinearisedSweep, LeavesOutLightFromBehindTheSensors) {
  const Stations stations = two_stations(Generation::kLighthouse2);
  const auto hits_of = [&](double turned_rad, double sigma_rad, const Target& target) {
    NetworkState state;
    state.pose = {rotation_exp({turned_rad, 0.0, 0.0}), Vector3(0.0, 0.0, 0.9)};
    state.covariance.topLeftCorner<3, 3>() = sigma_rad * sigma_rad * Matrix3::Identity();
    PlaneSweep sweep;
    sweep.station = 1;
    for (const SensorPlacement& sensor : target) {
      const Vector3 p = stations[1].T_world_station->inverse() * (state.pose * sensor.position_m);
      sweep.hits.push_back({1e-5 * sensor.sensor, sensor.sensor, raw_angle(stations[1], 0, p)});
    }
    const LinearisedSweep out = linearise(sweep, stations, target, state, 0.0, NetworkOptions{}.noise);
    EXPECT_EQ(out.sensors, 4);
    return out.hits();
  };
  EXPECT_EQ(hits_of(0.0, 0.03, deck()), 4);
  EXPECT_EQ(hits_of(kPi, 0.03, deck()), 0);
  EXPECT_EQ(hits_of(kPi, 0.5, deck()), 4);  // an attitude that is not known refuses nothing
  Target plain = deck();
  for (SensorPlacement& sensor : plain) sensor.normal.setZero();
  EXPECT_EQ(hits_of(kPi, 0.03, plain), 4);
}

// However long it is seen: 0.2 mm turn a target of 15 mm by 0.8 deg, one of 150 mm by a tenth of that.
TEST(NetworkTracker, StatesWhatSensorsThatAreNotInTheirPlacesTurnABodyBy) {
  const Stations stations = two_stations(Generation::kLighthouse2);
  const auto stated_rad = [&](double size) {
    Target target = deck();
    for (SensorPlacement& sensor : target) sensor.position_m *= size;
    const auto tracker = std::make_unique<NetworkTracker>(stations, target, NetworkOptions{});
    const WorldFromBody body{Matrix3::Identity(), Vector3(0.0, 0.0, 0.9)};
    double sigma_rad = 0.0;
    for (int k = 0; k < 400; ++k) {
      const std::size_t plane = static_cast<std::size_t>(k % 2), station = static_cast<std::size_t>(k / 2 % 2);
      for (const SensorPlacement& sensor : target) {
        const Vector3 p = stations[station].T_world_station->inverse() * (body * sensor.position_m);
        const Hit hit{k / 120.0 + 1e-5 * sensor.sensor, sensor.sensor, raw_angle(stations[station], plane, p)};
        const auto result = tracker->push(static_cast<std::uint8_t>(station), plane, hit);
        if (result && result->pose.ok()) sigma_rad = std::sqrt(result->covariance(0, 0));
      }
    }
    return sigma_rad;
  };
  const double small_rad = stated_rad(1.0), large_rad = stated_rad(10.0);
  EXPECT_GT(small_rad, 0.9 * 0.2e-3 / 0.015);
  EXPECT_LT(small_rad, 1.5 * 0.2e-3 / 0.015);
  EXPECT_LT(large_rad, 0.2 * small_rad);
}

}  // namespace
}  // namespace pharos::network
