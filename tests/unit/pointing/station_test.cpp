// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/station.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

// Paper 003, table 1, station columns: azimuth, elevation, pitch, yaw, direction as printed.
struct Row {
  LineOfSight sight;
  PitchYaw angles;
  Vector3 printed;
};
const std::array<Row, 4> kTable1 = {
    Row{{288 * kRadPerDeg, 52 * kRadPerDeg}, {-33.7 * kRadPerDeg, 72.0 * kRadPerDeg}, {0.79, 0.26, -0.55}},
    Row{{180 * kRadPerDeg, 71 * kRadPerDeg}, {-62.8 * kRadPerDeg, -0.01 * kRadPerDeg}, {0.00, 0.46, -0.89}},
    Row{{15 * kRadPerDeg, 55 * kRadPerDeg}, {77.9 * kRadPerDeg, 28.9 * kRadPerDeg}, {0.10, 0.18, 0.98}},
    Row{{138 * kRadPerDeg, 33 * kRadPerDeg}, {36.4 * kRadPerDeg, 41.9 * kRadPerDeg}, {0.54, 0.60, 0.59}}};

TEST(PitchYaw, FormulaOneGivesTableOnesDirections) {
  for (const Row& row : kTable1) {
    const Vector3 axis = axis_of(row.angles);
    EXPECT_LT((axis - row.printed).cwiseAbs().maxCoeff(), 0.0051 + 1e-3);
    const PitchYaw back = pitch_yaw(axis);
    EXPECT_NEAR(back.pitch_rad, row.angles.pitch_rad, 1e-12);
    EXPECT_NEAR(back.yaw_rad, row.angles.yaw_rad, 1e-12);
  }
}

TEST(Station, CameraFrameIsARotationWhoseAxesAreTheDocumentedOnes) {
  for (const Row& row : kTable1) {
    const Matrix3 R = camera_to_station(row.sight);
    EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    EXPECT_EQ(R(2, 0), 0.0) << "the horizon is level";
    EXPECT_LT(R(2, 1), 0.0) << "image down is towards the ground";
    EXPECT_LT((R.col(2) - direction_station(row.sight)).norm(), 1e-15);
  }
}

TEST(Station, AzimuthRunsFromNorthOverEast) {
  EXPECT_LT((direction_station({0.0, 0.0}) - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((direction_station({0.5 * kPi, 0.0}) - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_LT((direction_station({1.0, 0.5 * kPi}) - Vector3::UnitZ()).norm(), 1e-15);
}

TEST(Station, UpAtTheEquatorIsAwayFromTheEarthsCentreAndAtThePoleTheEarthsAxis) {
  EXPECT_LT((station_to_earth({0.0, 0.0}).col(2) - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_LT((station_to_earth({0.5 * kPi, 1.0}).col(2) - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((station_to_earth({0.3, 0.5 * kPi}).col(0) + Vector3::UnitX()).norm(), 1e-15) << "east";
}

TEST(SignedAxis, TakesTheUpperThenTheNorthernThenTheEasternEnd) {
  EXPECT_EQ(signed_axis({0.6, 0.0, -0.8}), Vector3(-0.6, 0.0, 0.8));
  EXPECT_EQ(signed_axis({0.6, 0.0, 0.8}), Vector3(0.6, 0.0, 0.8));
  EXPECT_EQ(signed_axis({0.6, -0.8, 0.0}), Vector3(-0.6, 0.8, 0.0));
  EXPECT_EQ(signed_axis({-1.0, 0.0, 0.0}), Vector3(1.0, 0.0, 0.0));
}

TEST(Earth, TurnsOnceInASiderealDay) {
  constexpr double kSiderealDay_s = 86164.0989;
  EXPECT_LT((earth_to_inertial(kSiderealDay_s) - Matrix3::Identity()).norm(), 1e-6);
  // After six hours Greenwich has moved to the east: from +x to +y, nearly.
  EXPECT_GT((earth_to_inertial(6 * 3600.0) * Vector3::UnitX()).y(), 0.99);
}

}  // namespace
}  // namespace pharos::pointing
