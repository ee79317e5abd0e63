// SPDX-License-Identifier: Apache-2.0
// Bodies of the integrity campaign, and what its rule of availability knows of them.
#include "tools/sim/tof/random_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {
namespace {

TEST(RandomTofBody, IsTheSameForTheSameSeed) {
  const RandomTofBody one = random_tof_body(5), same = random_tof_body(5), other = random_tof_body(6);
  EXPECT_EQ(one.scenario.poses[0].t, same.scenario.poses[0].t);
  EXPECT_EQ(one.scenario.satellite.clutter.size(), same.scenario.satellite.clutter.size());
  EXPECT_NE(one.scenario.poses[0].t, other.scenario.poses[0].t);
}

TEST(RandomTofBody, CarriesItsNearestConnectorOnXAndClutterBesideIt) {
  std::size_t clutter = 0;
  int covers = 0, hidden = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomTofBody body = random_tof_body(seed);
    const Satellite& satellite = body.scenario.satellite;
    ASSERT_GE(body.connectors, 1) << seed;
    EXPECT_EQ(satellite.connectors[0].direction_deg, 0.0);
    for (std::size_t k = 1; k < static_cast<std::size_t>(body.connectors); ++k) {
      EXPECT_GE(satellite.connectors[k].distance_m, satellite.connectors[0].distance_m + 0.02);
    }
    clutter += satellite.clutter.size();
    covers += body.has_look_alike ? 1 : 0;
    hidden += body.ring_seen < 0.9 ? 1 : 0;
    EXPECT_LE(body.ring_seen, 1.0 + 1e-9);
    if (body.ring_seen < 0.8) {
      EXPECT_TRUE(satellite.occluder.has_value()) << seed;  // a thin boom hides less
    }
  }
  EXPECT_GT(clutter, 40u);
  EXPECT_GT(covers, 3);
  EXPECT_GT(hidden, 5);
}

TEST(RandomTofBody, ClutterStandsWhereItIsSaidToStand) {
  RandomTofBody body = random_tof_body(3);
  Satellite& satellite = body.scenario.satellite;
  satellite.clutter.clear();
  satellite.occluder.reset();
  // A plate half way to the camera, before the ring's centre.
  const CameraFromTarget& pose = body.scenario.poses[0];
  const Vector3 eye = pose.inverse() * Vector3::Zero(), middle = 0.5 * eye;
  satellite.clutter.push_back(
      {SolidBox{{-0.1, -0.1, -0.01}, {0.1, 0.1, 0.01}}, Material{0.4}, Matrix3::Identity(), middle});
  TofSimulator simulator = simulator_of(body, 3);
  const Vector2 pixel = simulator.rays().project(pose.t);
  const auto at =
      static_cast<std::size_t>(std::lround(pixel.y())) * 640 + static_cast<std::size_t>(std::lround(pixel.x()));
  EXPECT_NEAR(static_cast<double>(simulator.ideal(0).range_m[at]), 0.5 * pose.t.norm(), 0.012);
}

}  // namespace
}  // namespace pharos::sim
