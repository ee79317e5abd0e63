// SPDX-License-Identifier: Apache-2.0
// Rays against surfaces whose equations are known.
#include "tools/sim/render/primitives.hpp"

#include <gtest/gtest.h>

#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

Vector3 random_vector(RandomStream& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

TEST(PlaneCoordinates, GiveBackTheCoordinatesOfAPointThatTheRayGoesTo) {
  RandomStream random(1, "planes");
  for (int i = 0; i < 100; ++i) {
    const Vector3 corner = random_vector(random) + Vector3(0.0, 0.0, 3.0);
    const Vector3 edge_s = random_vector(random), edge_t = random_vector(random);
    const PlaneCoordinates plane(corner, edge_s, edge_t);
    if (std::abs(plane.normal().dot(corner)) < 0.3 || edge_s.cross(edge_t).norm() < 0.1) continue;
    const double s = random.uniform(-1.0, 2.0), t = random.uniform(-1.0, 2.0), depth = random.uniform(0.5, 4.0);
    const Vector3 direction = (corner + s * edge_s + t * edge_t) / depth;
    EXPECT_NEAR(plane.depth(direction), depth, 1e-11);
    EXPECT_NEAR(plane.s(direction, depth), s, 1e-11);
    EXPECT_NEAR(plane.t(direction, depth), t, 1e-11);
  }
}

TEST(PlaneCoordinates, NormalIsAUnitVectorAcrossBothEdges) {
  const PlaneCoordinates plane({0.0, 0.0, 2.0}, {2.0, 0.0, 1.0}, {1.0, 3.0, 0.0});
  EXPECT_NEAR(plane.normal().norm(), 1.0, 1e-15);
  EXPECT_NEAR(plane.normal().dot(Vector3(2.0, 0.0, 1.0)), 0.0, 1e-15);
  EXPECT_NEAR(plane.normal().dot(Vector3(1.0, 3.0, 0.0)), 0.0, 1e-15);
}

TEST(PlaneCoordinates, APlaneBehindTheRayHasANegativeDepth) {
  const PlaneCoordinates plane({0.0, 0.0, -2.0}, Vector3::UnitX(), Vector3::UnitY());
  EXPECT_DOUBLE_EQ(plane.depth(Vector3::UnitZ()), -2.0);
}

TEST(MeetLevel, IsWhereThePointHasThatHeight) {
  EXPECT_DOUBLE_EQ(meet_level({1.0, 2.0, 5.0}, {0.3, 0.1, -2.0}, 1.0), 2.0);
}

TEST(MeetCone, BothPlacesLieOnTheConeNearerOneFirst) {
  RandomStream random(2, "cones");
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const double base = random.uniform(0.2, 1.0), slope = random.uniform(-0.8, 0.8), base_z = random.uniform(-1.0, 1.0);
    const Vector3 origin = 3.0 * random_vector(random), direction = random_vector(random);
    const auto [first, second] = meet_cone(origin, direction, base, slope, base_z);
    if (first == kNever) continue;
    ++met;
    EXPECT_LE(first, second);
    for (const double at : {first, second}) {
      const Vector3 p = origin + at * direction;
      const double radius = base + slope * (p.z() - base_z);
      EXPECT_NEAR(p.head<2>().norm(), std::abs(radius), 1e-8 * (1.0 + std::abs(at)));
    }
  }
  EXPECT_GT(met, 50);
}

TEST(MeetCone, OfNoSlopeIsACylinder) {
  const auto [first, second] = meet_cone({-5.0, 0.6, 0.0}, {1.0, 0.0, 0.2}, 1.0, 0.0, 0.0);
  EXPECT_NEAR(first, 5.0 - 0.8, 1e-14);
  EXPECT_NEAR(second, 5.0 + 0.8, 1e-14);
  EXPECT_EQ(meet_cone({-5.0, 1.1, 0.0}, {1.0, 0.0, 0.2}, 1.0, 0.0, 0.0)[0], kNever);
  EXPECT_EQ(meet_cone({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0, 0.0, 0.0)[0], kNever);  // along its axis
}

TEST(EnterBox, IsTheFaceThatTheRayComesThrough) {
  const Vector3 low(-1.0, -2.0, -3.0), high(1.0, 2.0, 3.0);
  const BoxEntry front = enter_box({0.2, 0.1, 10.0}, {0.0, 0.01, -2.0}, low, high);
  EXPECT_DOUBLE_EQ(front.at, 3.5);
  EXPECT_EQ(front.axis, 2);
  const BoxEntry side = enter_box({-4.0, 0.5, 0.5}, {1.0, 0.1, 0.2}, low, high);
  EXPECT_DOUBLE_EQ(side.at, 3.0);
  EXPECT_EQ(side.axis, 0);
}

TEST(EnterBox, MissesWhereTheRayPassesByOrBeginsInsideOrBehind) {
  const Vector3 low(-1.0, -1.0, -1.0), high(1.0, 1.0, 1.0);
  EXPECT_EQ(enter_box({0.0, 1.1, 5.0}, {0.0, 0.0, -1.0}, low, high).at, kNever);
  EXPECT_EQ(enter_box({0.0, 0.0, 0.0}, {0.3, 0.2, 1.0}, low, high).at, kNever);
  EXPECT_EQ(enter_box({0.0, 0.0, 5.0}, {0.0, 0.0, 1.0}, low, high).at, kNever);
}

}  // namespace
}  // namespace pharos::sim
