// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/source_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pharos/base/units.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

constexpr const char* kLighthouse =
    "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n"
    "1.5,0,0.6,0.8,0,0,0.1,-0.2,3,0.3,6,ok\n"
    "1.6,0,,,,,,,,,,refused_too_few\n";

TEST(SourceTable, ReadsPosesAndCountsRefusedRows) {
  const test::TemporaryFile file(kLighthouse);
  SourceTable table(file.path(), SourceKind::kLighthouse);
  const auto row = table.next();
  ASSERT_TRUE(row);
  EXPECT_EQ(row->time_s, 1.5);
  EXPECT_TRUE(row->has_turn);
  EXPECT_LT((row->pose.t - Vector3(0.1, -0.2, 3.0)).norm(), 1e-12);
  EXPECT_NEAR(row->pose.R(1, 1), -0.28, 1e-12);
  EXPECT_NEAR(row->covariance.topLeftCorner(3, 3).trace(), std::pow(0.3 * kRadPerDeg, 2), 1e-12);
  EXPECT_NEAR(row->covariance.bottomRightCorner(3, 3).trace(), std::pow(6e-3, 2), 1e-12);
  EXPECT_FALSE(table.next());
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.refused(), 1u);
}

TEST(SourceTable, LeavesTheTurnOfARingOpen) {
  const test::TemporaryFile file(
      "problem,time_s,theta_deg,gamma_deg,cx_m,cy_m,cz_m,sigma_deg,sigma_position_mm,status\n"
      "0,2.5,10,-20,0.1,0.2,2.5,0.2,3,ok\n");
  const auto row = SourceTable(file.path(), SourceKind::kRing2).next();
  ASSERT_TRUE(row);
  EXPECT_FALSE(row->has_turn);
  // n = Rx(theta) Ry(gamma) (0,0,-1), written out.
  const double theta = 10 * kRadPerDeg, gamma = -20 * kRadPerDeg;
  const Vector3 n(-std::sin(gamma), std::sin(theta) * std::cos(gamma), -std::cos(theta) * std::cos(gamma));
  EXPECT_LT((row->pose.R.col(2) - n).norm(), 1e-12);
  const Matrix3 rotation = row->covariance.topLeftCorner<3, 3>();
  EXPECT_NEAR(n.dot(rotation * n), 0.0, 1e-15);
  EXPECT_NEAR(rotation.trace(), std::pow(0.2 * kRadPerDeg, 2), 1e-12);
}

TEST(SourceTable, BuildsAnAttitudeFromTheTiltsOfATofPoseWithoutConnector) {
  const test::TemporaryFile file(
      "frame,tx_m,ty_m,tz_m,alpha_deg,beta_deg,gamma_deg,qw,qx,qy,qz,sigma_rot_deg,sigma_pos_mm,status\n"
      "20,0.1,0.2,2.5,10,-20,,,,,,0.2,3,ok\n");
  const auto row = SourceTable(file.path(), SourceKind::kTof, {std::nullopt, 10.0}).next();
  ASSERT_TRUE(row);
  EXPECT_EQ(row->time_s, 2.0);
  EXPECT_FALSE(row->has_turn);
  const double alpha = 10 * kRadPerDeg, beta = -20 * kRadPerDeg;  // diag(1,-1,-1) R = Rx(alpha) Ry(beta)
  const Vector3 z(std::sin(beta), std::sin(alpha) * std::cos(beta), -std::cos(alpha) * std::cos(beta));
  EXPECT_LT((row->pose.R.col(2) - z).norm(), 1e-12);
}

TEST(SourceTable, RefusesSeveralStationsAndMissingTimes) {
  const test::TemporaryFile stations(std::string(kLighthouse) + "1.7,1,1,0,0,0,0.1,-0.2,3,0.3,6,ok\n");
  const auto read = [&](const SourceTableChoice& choice) {
    SourceTable table(stations.path(), SourceKind::kLighthouse, choice);
    while (table.next()) {
    }
    return table.rows();
  };
  EXPECT_NE(test::error_of([&] { (void)read({}); }).find("line 4: column 'station': rows of several stations"),
            std::string::npos);
  EXPECT_EQ(read({1, std::nullopt}), 1u);
  const std::string columns = "frame,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n";
  const test::TemporaryFile frames(columns + "0012,1,0,0,0,0,0,1,0.1,1,ok\n");
  EXPECT_NE(test::error_of([&] { SourceTable(frames.path(), SourceKind::kTof).next(); }).find("line 2"),
            std::string::npos);
}

// Images are named by their time in ns: such a table needs neither a column nor a rate.
TEST(SourceTable, NamesOfSixteenDigitsAreTimes) {
  const test::TemporaryFile frames(
      "frame,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n"
      "1000162250000000,1,0,0,0,0,0,1,0.1,1,ok\n");
  EXPECT_DOUBLE_EQ(SourceTable(frames.path(), SourceKind::kTof).next()->time_s, 1000162.25);
  const test::TemporaryFile pairs(
      "problem,theta_deg,gamma_deg,cx_m,cy_m,cz_m,sigma_deg,sigma_position_mm,status\n"
      "1000162250000000,1,2,0,0,3,0.1,1,ok\n");
  EXPECT_DOUBLE_EQ(SourceTable(pairs.path(), SourceKind::kRing2).next()->time_s, 1000162.25);
}

TEST(SourceTable, RefusesAnAttitudeAndACovarianceThatAreNone) {
  const test::TemporaryFile attitude(
      "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n0.5,2,0,0,0,0,0,1,0.1,1,ok\n");
  EXPECT_NE(test::error_of([&] { (void)SourceTable(attitude.path(), SourceKind::kSlam).next(); }).find("line 2"),
            std::string::npos);
  std::string header = "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status",
              row = "0.5,1,0,0,0,0,0,1,1,1,ok";
  for (const std::string& name : upper_covariance_columns()) {
    header += "," + name;
    row += ",-1";
  }
  const test::TemporaryFile covariance(header + "\n" + row + "\n");
  EXPECT_NE(test::error_of([&] { (void)SourceTable(covariance.path(), SourceKind::kSlam).next(); }).find("covariance"),
            std::string::npos);
}

}  // namespace
}  // namespace pharos::host
