// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pharos::lighthouse {
namespace {

double uniform_in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Ranges of real stations.
Lh2Calibration random_lh2_station(std::mt19937& random) {
  Lh2Calibration station;
  for (PlaneCalibration& plane : station.plane) {
    plane = {uniform_in(random, -0.01, 0.01), uniform_in(random, -0.055, 0.055), uniform_in(random, -0.5, 0.5),
             uniform_in(random, -3.1, 3.1),   uniform_in(random, -0.01, 0.01),   uniform_in(random, -3.1, 3.1),
             uniform_in(random, -0.5, 0.5)};
  }
  return station;
}

Vector3 random_lh2_point(std::mt19937& random) {
  return Vector3(std::tan(uniform_in(random, -0.9, 0.9)), std::tan(uniform_in(random, -0.6, 0.6)), 1.0) *
         uniform_in(random, 0.5, 6.0);
}

// A plane is the set of directions that it holds when the rotor has turned by alpha: it stands vertically ahead at 0,
// tilted by -30 or +30 deg about the line of sight, and turns about the vertical axis to the left.
TEST(Lh2Model, IdealPlaneHoldsThePointThatItHits) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 p = random_lh2_point(random);
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      const double alpha = ideal_lh2_angle(plane, p).angle_rad;
      const double t = plane == 0 ? -lh2::kTilt_rad : lh2::kTilt_rad;
      const Vector3 up(0, -1, 0), left(-1, 0, 0), ahead(0, 0, 1);
      // In the rotor's frame the plane's normal is left, tilted; the point turned back by alpha lies in it.
      const Vector3 normal = std::cos(t) * left + std::sin(t) * up;
      const double c = std::cos(alpha), s = std::sin(alpha);
      const Vector3 turned =
          up * up.dot(p) + left * (c * left.dot(p) - s * ahead.dot(p)) + ahead * (s * left.dot(p) + c * ahead.dot(p));
      EXPECT_NEAR(normal.dot(turned) / p.norm(), 0.0, 1e-12);
    }
  }
}

TEST(Lh2Model, WithoutCalibrationItIsTheIdealOne) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 p = random_lh2_point(random);
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      EXPECT_NEAR(lh2_angle({}, plane, p), ideal_lh2_angle(plane, p).angle_rad, 1e-12);
    }
  }
}

TEST(Lh2Model, GradientsAreThoseOfCentralDifferences) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 100; ++trial) {
    const Lh2Calibration station = random_lh2_station(random);
    const Vector3 p = random_lh2_point(random);
    constexpr double kStep_m = 1e-5;
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
      const Vector3 exact = lh2_gradient(station.plane[plane], plane, p);
      const Vector3 ideal = ideal_lh2_angle(plane, p).gradient;
      for (int k = 0; k < 3; ++k) {
        const Vector3 d = kStep_m * Vector3::Unit(k);
        const double numeric =
            (lh2_angle(station.plane[plane], plane, p + d) - lh2_angle(station.plane[plane], plane, p - d)) /
            (2 * kStep_m);
        const double numeric_ideal =
            (ideal_lh2_angle(plane, p + d).angle_rad - ideal_lh2_angle(plane, p - d).angle_rad) / (2 * kStep_m);
        EXPECT_NEAR(exact[k], numeric, 1e-7);
        EXPECT_NEAR(ideal[k], numeric_ideal, 1e-7);
      }
    }
  }
}

TEST(Lh2Model, DirectionGivesBackTheAngles) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 300; ++trial) {
    const Lh2Calibration station = random_lh2_station(random);
    const Vector3 p = random_lh2_point(random);
    const PlaneAngles angles = {lh2_angle(station.plane[0], 0, p), lh2_angle(station.plane[1], 1, p)};
    const auto direction = lh2_direction(station, angles);
    ASSERT_TRUE(direction) << trial;
    EXPECT_NEAR((*direction - p.normalized()).norm(), 0.0, 1e-9);
  }
}

TEST(Lh2Model, ImpossibleAnglesHaveNoDirection) {
  EXPECT_FALSE(lh2_direction({}, {1.5, -1.5}));
  EXPECT_FALSE(lh2_direction({}, {NAN, 0.0}));
  EXPECT_FALSE(lh2_direction({}, {3.0, 3.0}));
}

}  // namespace
}  // namespace pharos::lighthouse
