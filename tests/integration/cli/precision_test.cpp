// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kPosesHeader = "pose,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";

Outcome precision(const std::string& poses, const std::string& more = "") {
  return pharos("precision --target " + ExampleRecording::get().target() + " --poses - " + more, poses);
}

std::string pose_row(const std::string& name, const LighthouseFromBody& pose) {
  const Quaternion q = pose.quaternion();
  std::string row = name;
  for (const double v : {q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()})
    row += "," + std::to_string(v);
  return row + "\n";
}

TEST(CliPrecision, PrintsTheColumnsOfTheContract) {
  const Outcome run = precision(kPosesHeader + pose_row("here", ExampleRecording::get().truth()));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(first_line(run.out),
              StartsWith("pose,visible,adop_deg_per_rad,pdop_m_per_rad,sigma_rot_deg,sigma_pos_mm"));
}

TEST(CliPrecision, PredictsWhatTrackReportsOfTheSameView) {
  const ExampleRecording& recording = ExampleRecording::get();
  for (const char* noise : {"--rho 0", "--rho 0.8717", "--sigma-arcsec 60"}) {
    const auto predicted = rows_of(precision(kPosesHeader + pose_row("here", recording.truth()), noise).out).at(0);
    const auto tracked = rows_of(
        pharos("track " + recording.edges() + " --method epoch --target " + recording.target() + " " + noise).out);
    const Row& last = tracked.at(tracked.size() / 2);
    ASSERT_EQ(2 * std::stoi(predicted.at("visible")), std::stoi(last.at("observations")));
    for (const char* column : {"adop_deg_per_rad", "pdop_m_per_rad", "sigma_rot_deg", "sigma_pos_mm"}) {
      EXPECT_NEAR(std::stod(predicted.at(column)) / std::stod(last.at(column)), 1.0, 0.01) << column << " " << noise;
    }
  }
}

TEST(CliPrecision, KeepsPosesThatNobodyCouldMeasure) {
  const Outcome run =
      precision(std::string(kPosesHeader) + "away,1,0,0,0,0,0,2\nnone,,,,,,,\nfacing,0,1,0,0,0.2,0,2\n");
  EXPECT_EQ(run.exit_code, 0);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("visible"), "0");
  EXPECT_EQ(rows[0].at("adop_deg_per_rad"), "");
  EXPECT_EQ(rows[0].at("status"), "refused_too_few_sensors");
  EXPECT_EQ(rows[1].at("visible"), "");
  EXPECT_EQ(rows[2].at("status"), "ok");
}

TEST(CliPrecision, EndsWith1WhenNoPoseCanBeMeasured) {
  EXPECT_EQ(precision(std::string(kPosesHeader) + "away,1,0,0,0,0,0,2\n").exit_code, 1);
}

TEST(CliPrecision, RefusesWhatIsNoRotation) {
  const Outcome run = precision(std::string(kPosesHeader) + "a,1,1,0,0,0,0,2\n");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("line 2"));
}

}  // namespace
}  // namespace pharos::cli_test
