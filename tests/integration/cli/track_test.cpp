// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/base/units.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kContractColumns =
    "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,adop_deg_per_rad,pdop_m_per_rad,rms_arcsec,"
    "observations,status,flags,alt_qw,alt_qx,alt_qy,alt_qz,alt_tx_m,alt_ty_m,alt_tz_m,delta_chi2";

Outcome track(const std::string& more = "") {
  return pharos("track " + recording().edges() + " --target " + recording().target() + " " + more);
}

LighthouseFromBody pose_of(const Row& row) {
  const auto n = [&](const char* name) { return std::stod(row.at(name)); };
  return {Quaternion(n("qw"), n("qx"), n("qy"), n("qz")).toRotationMatrix(), {n("tx_m"), n("ty_m"), n("tz_m")}};
}

TEST(CliTrack, PrintsTheColumnsOfTheContract) {
  const Outcome run = track();
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(first_line(run.out), StartsWith(kContractColumns));
}

TEST(CliTrack, FindsThePoseOfEveryCycleWithTheCalibrationThatTheStationSends) {
  const auto rows = rows_of(track("--method epoch").out);
  ASSERT_NEAR(static_cast<double>(rows.size()), 12 * 60, 10.0);
  std::size_t good = 0;
  for (const Row& row : rows) {
    EXPECT_THAT(row.at("flags"), Not(HasSubstr("uncalibrated")));
    if (row.at("status") != "ok") continue;
    ++good;
    const LighthouseFromBody pose = pose_of(row);
    // Half a tick of the counter is 4 urad: 0.05 deg and 0.5 mm for this target.
    EXPECT_LT((pose.t - recording().truth().t).norm(), 1e-3);
    EXPECT_LT(rotation_angle_between(pose.R, recording().truth().R) * kDegPerRad, 0.1);
    EXPECT_EQ(row.at("alt_qw"), "");
    EXPECT_EQ(row.at("delta_chi2"), "");
    EXPECT_GE(std::stod(row.at("qw")), 0.0);
  }
  EXPECT_GT(good, rows.size() - 5);
}

TEST(CliTrack, FindsThePoseOfEverySweepUnlessConfiguredOtherwise) {
  const std::string out = track().out;
  EXPECT_EQ(track("--method motion").out, out);
  const auto rows = rows_of(out);
  ASSERT_NEAR(static_cast<double>(rows.size()), 12 * 120, 20.0);
  std::size_t good = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].at("status") != "ok") continue;
    ++good;
    const LighthouseFromBody pose = pose_of(rows[i]);
    EXPECT_LT((pose.t - recording().truth().t).norm(), 1e-3);
    EXPECT_LT(rotation_angle_between(pose.R, recording().truth().R) * kDegPerRad, 0.1);
    EXPECT_GT(std::stod(rows[i].at("sigma_pos_mm")), 0.0);
  }
  EXPECT_GT(good, rows.size() - 10);
}

TEST(CliTrack, SaysWhatIsUncalibrated) {
  for (const Row& row : rows_of(track("--calibration none").out)) {
    EXPECT_THAT(row.at("flags"), HasSubstr("uncalibrated"));
  }
  // In a stream the calibration is received during the run.
  const Outcome live = pharos("track - --target " + recording().target(), recording().edges_text());
  EXPECT_EQ(live.exit_code, 0);
  EXPECT_THAT(rows_of(live.out).front().at("flags"), HasSubstr("uncalibrated"));
  EXPECT_THAT(rows_of(live.out).back().at("flags"), Not(HasSubstr("uncalibrated")));
  EXPECT_THAT(live.err, HasSubstr("uncalibrated"));
}

TEST(CliTrack, TakesACalibrationFromAFileById) {
  const Folder folder;
  const std::string file = folder.write("stations.toml",
                                        "[[station]]\nid = \"BEC08E38\"\nphase_rad = [0.03, 0.03]\n"
                                        "tilt_rad = [0.002, 0.002]\ncurve_rad = [-0.002, -0.002]\n"
                                        "gibbous_phase_rad = [1.0, 1.0]\ngibbous_magnitude_rad = [0.004, 0.004]\n");
  const auto rows = rows_of(track("--calibration " + file).out);
  ASSERT_FALSE(rows.empty());
  EXPECT_THAT(rows.front().at("flags"), Not(HasSubstr("uncalibrated")));
  EXPECT_LT((pose_of(rows.back()).t - recording().truth().t).norm(), 1e-3);
}

TEST(CliTrack, TakesTheStationFileThatTheSimulatorWrites) {
  const std::string by_ootx = track().out;
  EXPECT_EQ(track("--calibration " + recording().stations()).out, by_ootx);
  // Without systematic errors the OOTX calibration is exact.
  EXPECT_EQ(track("--calibration " + recording().true_stations()).out, by_ootx);
  const Outcome from_pipe = pharos("track " + recording().edges() + " --calibration - --target " + recording().target(),
                                   content_of(recording().stations()));
  EXPECT_EQ(from_pipe.out, by_ootx);
}

TEST(CliTrack, SaysFileLineAndKeyOfABadCalibration) {
  const Folder folder;
  const std::string file = folder.write("stations.toml", "[[station]]\nid = \"BEC08E38\"\nfase_rad = [0.03, 0.03]\n");
  const Outcome run = track("--calibration " + file);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("stations.toml:3"));
  EXPECT_THAT(run.err, HasSubstr("fase_rad"));
}

TEST(CliTrack, ScalesItsSigmasWithTheGivenNoise) {
  const Row at_8_8 = rows_of(track("--method epoch").out).back();
  const Row at_88 = rows_of(track("--method epoch --sigma-arcsec 88").out).back();
  EXPECT_NEAR(std::stod(at_88.at("sigma_rot_deg")) / std::stod(at_8_8.at("sigma_rot_deg")), 10.0, 1e-3);
  EXPECT_NEAR(std::stod(at_88.at("sigma_pos_mm")) / std::stod(at_8_8.at("sigma_pos_mm")), 10.0, 1e-3);
  EXPECT_NEAR(std::stod(at_88.at("adop_deg_per_rad")) / std::stod(at_8_8.at("adop_deg_per_rad")), 1.0, 1e-3);
}

TEST(CliTrack, ShowsWhatIsLeftOfEverySensor) {
  const Folder folder;
  const Outcome run = track("--method epoch --sensors " + folder.path("sensors.csv"));
  EXPECT_EQ(run.exit_code, 0);
  const auto rows = rows_of(content_of(folder.path("sensors.csv")));
  EXPECT_GE(rows.size(), 8u);
  for (const Row& row : rows) EXPECT_LT(std::abs(std::stod(row.at("mean_arcsec"))), 2.0) << row.at("sensor");
}

TEST(CliTrack, RefusedCyclesKeepTheirPlaceWithEmptyFields) {
  // A target whose sensors have other numbers: nothing can be solved.
  std::string other = "sensor,x_m,y_m,z_m\n";
  for (int i = 0; i < 4; ++i) {
    other += std::to_string(20 + i) + "," + std::to_string(0.02 * i) + "," + std::to_string(0.01 * i * i) + ",0\n";
  }
  const Folder folder;
  const Outcome run = pharos("track " + recording().edges() + " --target " + folder.write("other.csv", other));
  EXPECT_EQ(run.exit_code, 1);
  const auto rows = rows_of(run.out);
  ASSERT_GT(rows.size(), 700u);
  for (const Row& row : rows) {
    EXPECT_THAT(row.at("status"), StartsWith("refused_"));
    EXPECT_NE(row.at("time_s"), "");
    for (const char* name : {"qw", "tz_m", "sigma_rot_deg", "pdop_m_per_rad", "rms_arcsec", "alt_qw", "delta_chi2"}) {
      EXPECT_EQ(row.at(name), "");
    }
  }
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
}

TEST(CliTrack, GivesAmbiguousPosesBothSolutions) {
  const Folder folder;
  const Outcome run = pharos("track " + recording().edges() + " --method epoch --sigma-arcsec 600 --target " +
                             folder.write("plane.csv", plane_target_csv()));
  EXPECT_THAT(run.err, HasSubstr("one plane"));
  std::size_t ambiguous = 0;
  for (const Row& row : rows_of(run.out)) {
    const bool is = row.at("status") == "ambiguous";
    ambiguous += is ? 1 : 0;
    EXPECT_EQ(row.at("delta_chi2").empty(), !is);
    EXPECT_EQ(row.at("alt_tz_m").empty(), !is);
    if (is) {
      EXPECT_LT(std::stod(row.at("delta_chi2")), 9.21);
    }
  }
  EXPECT_GT(ambiguous, 100u);
}

}  // namespace
}  // namespace pharos::cli_test
