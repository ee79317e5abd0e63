// SPDX-License-Identifier: Apache-2.0
// --format and --covariance of the commands that print poses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "pharos/base/units.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

constexpr double kTinyFraction = 1e-9;  // of printed numbers, which read back exactly; roots are taken once more

double value_of(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

// The covariance as its columns are named.
Matrix6 covariance_of(const Row& row) {
  constexpr std::array kNames = {"rx", "ry", "rz", "tx", "ty", "tz"};
  Matrix6 covariance;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const char* unit = i < 3 && j < 3 ? "_rad2" : i < 3 || j < 3 ? "_rad_m" : "_m2";
      const auto name = [&](int k) { return std::string(kNames[static_cast<std::size_t>(k)]); };
      covariance(i, j) = value_of(row, "cov_" + name(i) + "_" + name(j) + unit);
    }
  }
  return covariance;
}

void expect_near_fraction(double value, double expected) {
  EXPECT_NEAR(value, expected, kTinyFraction * std::abs(expected));
}

void expect_symmetric(const Matrix6& covariance) {
  EXPECT_LE((covariance - covariance.transpose()).norm(), kTinyFraction * covariance.norm());
}

// The roots of the traces are the sigmas of the row.
void expect_sigmas(const Row& row) {
  const Matrix6 covariance = covariance_of(row);
  expect_symmetric(covariance);
  const double rotation_rad = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  const double position_m = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  expect_near_fraction(rotation_rad * kDegPerRad, value_of(row, "sigma_rot_deg"));
  expect_near_fraction(position_m * kMmPerM, value_of(row, "sigma_pos_mm"));
}

std::string track_command() {
  return "track " + recording().edges() + " --target " + recording().target() + " --method epoch ";
}

TEST(CliExportTrack, TheCovarianceReadBackIsThatOfTheSigmas) {
  const Outcome run = pharos(track_command() + "--covariance");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::size_t compared = 0;
  for (const Row& row : rows_of(run.out)) {
    if (row.at("status").starts_with("refused")) {
      EXPECT_EQ(row.at("cov_rx_rx_rad2"), "");
      continue;
    }
    expect_sigmas(row);
    ++compared;
  }
  EXPECT_GT(compared, 500U);
}

TEST(CliExportTrack, WithoutOptionsTheTableIsTheOneWithoutItsLastColumns) {
  const std::string plain = pharos(track_command()).out;
  EXPECT_EQ(pharos(track_command() + "--format csv").out, plain);
  const Outcome json = pharos(track_command() + "--format json --covariance");
  EXPECT_EQ(count_lines(json.out) + 1, count_lines(plain));
  EXPECT_THAT(first_line(json.out), HasSubstr("\"cov_tz_tz_m2\":"));
  EXPECT_EQ(pharos(track_command() + "--json").out, pharos(track_command() + "--format json").out);
}

TEST(CliExportTrack, TumIsReadByEvaluateAndHoldsTheGoodPosesOfTheTable) {
  const Folder folder;
  const std::string tum = folder.path("poses.tum"), csv = folder.path("poses.csv");
  const Outcome run = pharos(track_command() + "--format tum -o " + tum);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(pharos(track_command() + "-o " + csv).exit_code, 0);
  std::size_t good = 0, rows = 0;
  for (const Row& row : rows_of(content_of(csv))) {
    ++rows;
    if (row.at("status") == "ok") ++good;
  }
  EXPECT_EQ(count_lines(content_of(tum)), good);
  if (good < rows) {
    EXPECT_THAT(run.err, HasSubstr(std::to_string(rows - good) + " rows have no TUM line"));
  }
  const Outcome compared = pharos("evaluate " + tum + " " + csv + " --align none --json");
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("\"compared\":" + std::to_string(good)));
}

TEST(CliExportTrack, AStationIsChosenForTumAlone) {
  const Outcome other = pharos(track_command() + "--format tum --station 1");
  EXPECT_EQ(other.out, "") << "the recording has one station, 0";
  EXPECT_THAT(other.err, HasSubstr("of another station or source"));
  EXPECT_EQ(pharos(track_command() + "--station 0").exit_code, 2);
}

TEST(CliExport, TumHasNoPlaceForACovariance) {
  for (const std::string& command :
       {track_command(), std::string("tof . --camera c "), std::string("slam a b --rig c "), std::string("listen ")}) {
    const Outcome run = pharos(command + "--format tum --covariance");
    EXPECT_EQ(run.exit_code, 2) << command;
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
  }
}

// Ellipses of the installed sweep scenario and their rig.
class CliExportCircles : public ::testing::Test {
 protected:
  CliExportCircles() {
    const std::string scenario = std::string(PHAROS_SCENARIOS) + "/stereo_sweep.toml";
    made_ = pharos("sim stereo " + scenario + " --seed 1 --output " + folder_.path("out"));
  }
  Outcome circles(const std::string& more) const {
    return pharos("circles --ellipses " + folder_.path("out/ellipses.csv") + " --rig " + folder_.path("out/rig.toml") +
                  " " + more);
  }
  Folder folder_;
  Outcome made_;
};

TEST_F(CliExportCircles, TheCovarianceReadBackIsThatOfTheSigmasWithAnyTurnAboutTheNormal) {
  ASSERT_EQ(made_.exit_code, 0) << made_.err;
  const Outcome run = circles("--covariance");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::size_t compared = 0;
  for (const Row& row : rows_of(run.out)) {
    if (row.at("status").starts_with("refused")) continue;
    const Matrix6 covariance = covariance_of(row);
    expect_symmetric(covariance);
    const Vector3 normal(value_of(row, "nx"), value_of(row, "ny"), value_of(row, "nz"));
    const Matrix3 rotation = covariance.topLeftCorner<3, 3>();
    const double turn_rad2 = normal.dot(rotation * normal);
    EXPECT_NEAR(turn_rad2, std::numbers::pi * std::numbers::pi / 3.0, 1e-9);
    // The variance across the normal is a difference of pi^2/3 and 1e-8 rad^2: six digits of it are left.
    EXPECT_NEAR(std::sqrt(rotation.trace() - turn_rad2) * kDegPerRad, value_of(row, "sigma_deg"),
                1e-4 * value_of(row, "sigma_deg"));
    const Matrix3 position = covariance.bottomRightCorner<3, 3>();
    expect_near_fraction(std::sqrt(position.trace()) * kMmPerM, value_of(row, "sigma_position_mm"));
    expect_near_fraction(position(0, 2), value_of(row, "centre_cov_xz_m2"));
    ++compared;
  }
  EXPECT_EQ(compared, rows_of(run.out).size());
}

TEST_F(CliExportCircles, TumHoldsTheCentreAndTheNormalAndSaysThatTheTurnIsNotMeasured) {
  const Outcome run = circles("--format tum");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the turn about the ring's axis is not measured"));
  const auto rows = rows_of(circles("").out);
  std::istringstream lines(run.out);
  std::size_t compared = 0;
  for (const Row& row : rows) {
    if (row.at("status") != "ok") continue;
    double time_s = 0.0, x = 0.0, y = 0.0, z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
    ASSERT_TRUE(lines >> time_s >> x >> y >> z >> qx >> qy >> qz >> qw);
    EXPECT_EQ(time_s, value_of(row, "problem"));
    EXPECT_EQ(z, value_of(row, "cz_m"));
    const Vector3 normal = Quaternion(qw, qx, qy, qz).toRotationMatrix().col(2);
    EXPECT_NEAR(normal.x(), value_of(row, "nx"), 1e-12);
    EXPECT_NEAR(normal.z(), value_of(row, "nz"), 1e-12);
    ++compared;
  }
  EXPECT_EQ(count_lines(run.out), compared);
  const std::string tum = folder_.write("circles.tum", run.out);
  EXPECT_EQ(pharos("evaluate " + tum + " " + tum + " --align none").exit_code, 0);
}

TEST_F(CliExportCircles, ThePapersMethodHasNoCovariance) {
  const auto rows = rows_of(circles("--covariance --method paper").out);
  ASSERT_FALSE(rows.empty());
  for (const Row& row : rows) EXPECT_EQ(row.at("cov_tx_tx_m2"), "");
}

// Two rendered frames of a docking ring.
class CliExportTof : public ::testing::Test {
 protected:
  CliExportTof() {
    made_ = pharos("sim tof - --seed 1 --output " + folder_.path("frames"),
                   "[trajectory]\nkind = \"still\"\nframes_per_pose = 2\nposes = [[0.1, -0.05, 3.0, 10.0, -15.0, "
                   "30.0]]\n");
  }
  Outcome tof(const std::string& more) const {
    return pharos("tof " + folder_.path("frames") + " --camera " + folder_.path("frames/camera.toml") + " " + more);
  }
  Folder folder_;
  Outcome made_;
};

TEST_F(CliExportTof, TheCovarianceReadBackIsThatOfTheSigmas) {
  ASSERT_EQ(made_.exit_code, 0) << made_.err;
  for (const char* window : {"", "--window 2 "}) {
    const auto rows = rows_of(tof(std::string(window) + "--covariance").out);
    ASSERT_FALSE(rows.empty());
    for (const Row& row : rows) expect_sigmas(row);
  }
}

TEST_F(CliExportTof, WithoutAConnectorTheVarianceOfTheTurnIsThatOfAUniformAngle) {
  const auto with = rows_of(tof("").out);
  const auto rows = rows_of(tof("--covariance --connectors 8").out);
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_THAT(rows[k].at("flags"), HasSubstr("no_connector"));
    // Both have one normal, Z' of the pose with a turn.
    const Row& turned = with[k];
    const Quaternion q(value_of(turned, "qw"), value_of(turned, "qx"), value_of(turned, "qy"), value_of(turned, "qz"));
    const Vector3 normal = q.toRotationMatrix().col(2);
    const Matrix3 rotation = covariance_of(rows[k]).topLeftCorner<3, 3>();
    const double turn_rad2 = normal.dot(rotation * normal);
    EXPECT_NEAR(turn_rad2, std::numbers::pi * std::numbers::pi / 3.0, 1e-3);
    EXPECT_NEAR(std::sqrt(rotation.trace() - turn_rad2) * kDegPerRad, value_of(rows[k], "sigma_rot_deg"),
                1e-2 * value_of(rows[k], "sigma_rot_deg"));
  }
}

TEST_F(CliExportTof, TumHoldsFramesWithATurnByTheirNumbers) {
  const std::string tum = folder_.write("poses.tum", tof("--format tum").out);
  const std::string csv = folder_.write("poses.csv", tof("").out);
  EXPECT_EQ(count_lines(content_of(tum)), 2U);
  const Outcome compared = pharos("evaluate " + tum + " " + csv + " --align none --json");
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("\"compared\":2"));
  const Outcome none = tof("--format tum --connectors 8");
  EXPECT_EQ(none.out, "");
  EXPECT_THAT(none.err, HasSubstr("2 rows have no TUM line: 2 without a measured turn about their axis"));
  EXPECT_EQ(tof("--format tum --summary").exit_code, 2);
}

}  // namespace
}  // namespace pharos::cli_test
