// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tests/unit/sim/simulated_light.hpp"

namespace pharos::sim {
namespace {

TEST(CarriedTrajectory, RestsInEachPoseAndMovesSmoothlyBetween) {
  RoomFromBody a{Matrix3::Identity(), {0.0, 0.0, 1.0}};
  RoomFromBody b{rotation_exp(Vector3(0.0, 1.0, 0.0)), {1.0, 0.0, 1.0}};
  const CarriedTrajectory carried({a, b}, 3.0, 1.0);
  for (const double time_s : {-1.0, 0.0, 1.9}) EXPECT_EQ(carried.at(time_s).t, a.t);
  for (const double time_s : {3.0, 5.0, 99.0}) EXPECT_LT(pose_difference(carried.at(time_s), b).norm(), 1e-12);
  EXPECT_NEAR(carried.at(2.5).t.x(), 0.5, 1e-12);
  EXPECT_NEAR(rotation_log(carried.at(2.5).R).y(), 0.5, 1e-12);
  EXPECT_LT((carried.at(2.01).t - a.t).norm(), 2e-5);
  EXPECT_TRUE(carried.lit(2.5));
}

TEST(StationaryTrajectory, HoldsEachPoseAndIsDarkBetween) {
  const RoomFromBody a{facing(), {0, 0, 1}};
  const RoomFromBody b{facing(), {0, 0, 2}};
  const StationaryTrajectory rest({a, b}, 5.0, 0.5);
  EXPECT_EQ(rest.at(4.9).t.z(), 1.0);
  EXPECT_EQ(rest.at(5.1).t.z(), 2.0);
  EXPECT_EQ(rest.at(99.0).t.z(), 2.0);
  EXPECT_TRUE(rest.lit(4.4));
  EXPECT_FALSE(rest.lit(4.6));
  EXPECT_TRUE(rest.lit(9.9)) << "nothing follows the last pose";
}

TEST(WaypointTrajectory, PassesThroughItsWaypointsSmoothly) {
  RandomStream random(11, "waypoints");
  std::vector<Waypoint> waypoints;
  Matrix3 R = facing();
  for (int i = 0; i < 8; ++i) {
    R = R * rotation_exp(Vector3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)));
    waypoints.push_back({i * 1.5, {R, {random.normal(), random.normal(), 3.0}}});
  }
  const WaypointTrajectory spline(waypoints);
  for (const Waypoint& waypoint : waypoints) {
    EXPECT_LT((spline.at(waypoint.time_s).t - waypoint.pose.t).norm(), 1e-12);
    EXPECT_LT(rotation_angle_between(spline.at(waypoint.time_s).R, waypoint.pose.R), 1e-7);
  }
  // The velocity is continuous at a waypoint.
  const double at = waypoints[3].time_s;
  const double step = 1e-5;
  const Vector3 before = (spline.at(at).t - spline.at(at - step).t) / step;
  const Vector3 after = (spline.at(at + step).t - spline.at(at).t) / step;
  EXPECT_LT((after - before).norm(), 1e-3);
  EXPECT_EQ(spline.at(-5.0).t, waypoints.front().pose.t);
  EXPECT_LT((spline.at(99.0).t - waypoints.back().pose.t).norm(), 1e-12);
}

TEST(Manoeuvre, StaysInItsVolumeAndReachesItsGreatestSpeedAndRate) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ManoeuvreLimits limits;
    limits.speed_m_s = 2.0;
    limits.rate_deg_s = 180.0;
    const auto trajectory = make_random_manoeuvre(limits, 30.0, RandomStream(seed, "manoeuvre test"));
    double speed = 0.0;
    double rate = 0.0;
    RoomFromBody before = trajectory->at(0.0);
    const double step = 0.002;
    for (double time = step; time < 30.0; time += step) {
      const RoomFromBody now = trajectory->at(time);
      EXPECT_TRUE((now.t.array() >= limits.low_m.array() - 1e-9).all());
      EXPECT_TRUE((now.t.array() <= limits.high_m.array() + 1e-9).all());
      EXPECT_LT(std::abs(now.t.x() / now.t.z()), std::tan(50.0 * kRadPerDeg) + 1e-9);
      speed = std::max(speed, (now.t - before.t).norm() / step);
      rate = std::max(rate, rotation_angle_between(now.R, before.R) / step);
      before = now;
    }
    EXPECT_NEAR(speed, 2.0, 0.1);
    EXPECT_NEAR(rate * kDegPerRad, 180.0, 5.0);
  }
}

TEST(RandomStationaryPoses, ShowsAsManySensorsAsAskedFor) {
  const Target target = frustum();
  RandomStationaryPoses limits;
  limits.count = 200;
  limits.min_lit = 5;
  for (const RoomFromBody& pose : random_stationary_poses(limits, target, 60.0, RandomStream(1, "rest test"))) {
    int lit = 0;
    for (const SensorPlacement& sensor : target) {
      const Vector3 to_station = -(pose * sensor.position_m).normalized();
      if ((pose.R * sensor.normal).dot(to_station) > 0.5) ++lit;
    }
    EXPECT_GE(lit, 5);
    EXPECT_GE(pose.t.norm(), limits.min_range_m);
    EXPECT_LE(pose.t.norm(), limits.max_range_m);
  }
  limits.min_lit = 12;  // a frustum never shows all its faces within 60 deg
  limits.count = 1;
  EXPECT_THROW(random_stationary_poses(limits, target, 30.0, RandomStream(1, "rest test")), host::InputError);
}

}  // namespace
}  // namespace pharos::sim
