// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <charconv>

#include "pharos/lighthouse/station_model.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kSolveColumns =
    "problem,qw,qx,qy,qz,tx_m,ty_m,tz_m,rms_arcsec,adop_deg_per_rad,pdop_m_per_rad,iterations,status";

std::string exact(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// Rows of a problem without noise, for sensors 0 to `sensors`-1 of the solid target.
std::string problem_rows(const std::string& name, std::size_t sensors) {
  const ExampleRecording& recording = ExampleRecording::get();
  std::string text;
  for (std::size_t i = 0; i < sensors; ++i) {
    const SensorPlacement& placement = recording.target_as_built()[i];
    const auto theta = lighthouse::ideal_thetas(recording.truth() * placement.position_m);
    text += name + "," + std::to_string(placement.sensor) + "," + exact(theta.x_rad) + "," + exact(theta.y_rad) + "\n";
  }
  return text;
}

constexpr const char* kHeader = "problem,sensor,theta_x_rad,theta_y_rad\n";

Outcome solve(const std::string& problems, const std::string& more = "") {
  return pharos("solve - --target " + ExampleRecording::get().target() + " " + more, problems);
}

TEST(CliSolve, PrintsTheColumnsOfTheContract) {
  const Outcome run = solve(kHeader + problem_rows("1", 8));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(first_line(run.out), StartsWith(kSolveColumns));
}

TEST(CliSolve, FindsTheTruthFromExactBearingsWhateverTheStart) {
  for (const char* start : {"auto", "p3p", "rpnp", "dlt"}) {
    for (const char* residual : {"angle", "tangent"}) {
      const Outcome run =
          solve(kHeader + problem_rows("one", 12), std::string("--start ") + start + " --residual " + residual);
      const auto rows = rows_of(run.out);
      ASSERT_EQ(rows.size(), 1u);
      EXPECT_EQ(rows[0].at("status"), "ok") << start << " " << residual;
      const Vector3& t = ExampleRecording::get().truth().t;
      EXPECT_NEAR(std::stod(rows[0].at("tx_m")), t.x(), 1e-6) << start << " " << residual;
      EXPECT_NEAR(std::stod(rows[0].at("tz_m")), t.z(), 1e-6) << start << " " << residual;
      EXPECT_LT(std::stod(rows[0].at("rms_arcsec")), 1e-3);
    }
  }
}

TEST(CliSolve, RefusesWithAReasonAndKeepsTheRow) {
  const Outcome run = solve(kHeader + problem_rows("few", 2) + problem_rows("good", 8) + "strange,30,1.5,1.5\n" +
                            "strange,31,1.6,1.5\nstrange,29,1.6,1.6\nstrange,28,1.5,1.6\n");
  EXPECT_EQ(run.exit_code, 0);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("problem"), "few");
  EXPECT_EQ(rows[0].at("status"), "refused_too_few_sensors");
  EXPECT_EQ(rows[0].at("qw"), "");
  EXPECT_EQ(rows[0].at("iterations"), "");
  EXPECT_EQ(rows[1].at("status"), "ok");
  EXPECT_EQ(rows[2].at("status"), "refused_unknown_sensors");
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
}

TEST(CliSolve, AProblemOfTooManyAnglesIsRefusedAndTheRunGoesOn) {
  std::string many;
  for (int i = 0; i < 65; ++i) many += "many,0,1.5,1.5\n";
  const auto rows = rows_of(solve(kHeader + many + problem_rows("good", 8), "--time 1").out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("status"), "refused_too_many_angles");
  EXPECT_EQ(rows[0].at("qw"), "");
  EXPECT_EQ(rows[0].at("observations"), "130");
  EXPECT_EQ(rows[1].at("status"), "ok");
}

TEST(CliSolve, EndsWith1WhenNothingCouldBeSolved) {
  const Outcome run = solve(kHeader + problem_rows("few", 2));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(count_lines(run.out), 2u);
  EXPECT_EQ(solve(kHeader).exit_code, 1);
}

TEST(CliSolve, AllowsEitherAngleToBeMissing) {
  std::string rows = problem_rows("1", 8);
  const std::size_t last = rows.rfind(',');
  rows = rows.substr(0, last) + ",\n";
  const auto solved = rows_of(solve(kHeader + rows).out);
  ASSERT_EQ(solved.size(), 1u);
  EXPECT_EQ(solved[0].at("status"), "ok");
  EXPECT_EQ(solved[0].at("observations"), "15");
}

TEST(CliSolve, GathersRowsThatDoNotStandTogether) {
  const std::string a = problem_rows("a", 8);
  const std::string b = problem_rows("b", 8);
  const std::size_t cut = a.find('\n') + 1;
  const auto mixed = rows_of(solve(kHeader + a.substr(0, cut) + b + a.substr(cut)).out);
  ASSERT_EQ(mixed.size(), 2u);
  EXPECT_EQ(mixed[0].at("problem"), "a");
  EXPECT_EQ(mixed[0].at("observations"), "16");
}

TEST(CliSolve, ReportsTheMedianTime) {
  const Outcome run = solve(kHeader + problem_rows("1", 8), "--time 20");
  EXPECT_THAT(run.err, ::testing::ContainsRegex("median [0-9]+ ns per solve"));
  EXPECT_EQ(run.out, solve(kHeader + problem_rows("1", 8)).out);
}

TEST(CliSolve, AnglesThatNoStationShowsAreRefusedNotFatal) {
  const Outcome run = solve(kHeader + problem_rows("good", 8) + "bad,0,-1,1\nbad,1,4,1\nbad,2,1,1\nbad,3,1,2\n");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(rows_of(run.out).at(1).at("status"), "refused_bad_input");
}

}  // namespace
}  // namespace pharos::cli_test
