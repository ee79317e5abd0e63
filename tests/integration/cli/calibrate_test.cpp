// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/calibrate/calibration_file.hpp"
#include "host/table/target_file.hpp"
#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;

using ::testing::HasSubstr;

using ::testing::StartsWith;

// A target with stationary intervals, and the same one in flight; simulated once.
class CliCalibrate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    folder_->write("target12.csv", content_of(PHAROS_SCENARIOS "/target12.csv"));
    const std::string head =
        "target = \"target12.csv\"\nerrors = \"workshop\"\n[[station]]\ncalibration = \"typical\"\n";
    folder_->write("rests.toml", "duration_s = 30.0\n" + head +
                                     "[trajectory]\nkind = \"rest\"\nrandom_poses = 12\nmin_range_m = 1.0\n"
                                     "max_range_m = 2.5\nmin_lit = 6\nhold_s = 2.5\nmove_s = 0.8\n");
    folder_->write("flight.toml", "duration_s = 12.0\n" + head +
                                      "[trajectory]\nkind = \"manoeuvre\"\nspeed_m_s = 0.1\n"
                                      "rate_deg_s = 5.0\n");
    for (const std::string name : {"rests", "flight"}) {
      pharos("sim lighthouse " + folder_->path(name + ".toml") + " --seed 5 --output " + folder_->path(name));
    }
    outcome_ = new Outcome(calibrate("--length " + length(4, 8, 0.0) + " --output " + file("cal.toml") +
                                     " --residuals " + file("residuals.csv") + " --picture " + file("residuals.svg")));
  }
  static void TearDownTestSuite() {
    delete outcome_;
    delete folder_;
  }
  static std::string file(const std::string& name) { return folder_->path(name); }
  static std::string length(std::uint8_t a, std::uint8_t b, double more_m) {
    const Target target = host::read_target(file("rests/target_true.csv")).target;
    const double metres = (find_sensor(target, a)->position_m - find_sensor(target, b)->position_m).norm() + more_m;
    return std::to_string(a) + "," + std::to_string(b) + "," + std::to_string(metres) + ",0.00002";
  }
  static Outcome calibrate(const std::string& more) {
    return pharos("calibrate lighthouse " + file("rests/edges.csv.gz") + " --target " + file("rests/target.csv") + " " +
                  more);
  }
  static double rms_mm(const std::string& calibration) {
    const Outcome run = pharos("track " + file("flight/edges.csv.gz") + " --method epoch --target " +
                               file("flight/target.csv") + " --calibration " + calibration);
    const auto truth = rows_of(content_of(file("flight/truth.csv")));
    double square = 0.0;
    double count = 0.0;
    for (const Row& row : rows_of(run.out)) {
      if (row.at("status") != "ok") continue;
      const double time_s = std::stod(row.at("time_s"));
      const auto at = std::lower_bound(truth.begin(), truth.end(), time_s,
                                       [](const Row& r, double t) { return std::stod(r.at("time_s")) < t; });
      if (at == truth.end()) continue;
      for (const char* column : {"tx_m", "ty_m", "tz_m"}) {
        const double error = std::stod(row.at(column)) - std::stod(at->at(column));
        square += error * error;
      }
      count += 1.0;
    }
    return count > 100.0 ? 1e3 * std::sqrt(square / count) : 1e9;
  }

  static Folder* folder_;
  static Outcome* outcome_;
};
Folder* CliCalibrate::folder_ = nullptr;
Outcome* CliCalibrate::outcome_ = nullptr;

TEST_F(CliCalibrate, WritesAFileTablesAndAPicture) {
  EXPECT_EQ(outcome_->exit_code, 0) << outcome_->err;
  EXPECT_EQ(first_line(outcome_->out), "parameter,prior,value,prior_sigma,sigma,told");
  EXPECT_EQ(rows_of(outcome_->out).size(), 3u * 12u + 2u * 5u);
  EXPECT_THAT(outcome_->err, AllOf(HasSubstr("stills in 12 poses"), HasSubstr("scale measured")));
  const auto residuals = rows_of(content_of(file("residuals.csv")));
  ASSERT_FALSE(residuals.empty());
  EXPECT_EQ(residuals.front().at("station_id"), "BEC08E38");
  EXPECT_THAT(content_of(file("residuals.svg")), AllOf(StartsWith("<svg"), HasSubstr("rotor y")));
}

TEST_F(CliCalibrate, WhatItWritesMakesTrackingBetter) { EXPECT_LT(rms_mm(file("cal.toml")), 0.5 * rms_mm("ootx")); }

TEST_F(CliCalibrate, SaysThatTheScaleIsThePriorsWithoutALength) {
  const Outcome run = calibrate("--output -");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("scale = \"prior\""));
  EXPECT_THAT(run.err, HasSubstr("--length"));
}

TEST_F(CliCalibrate, RefusesWhatCannotBe) {
  const auto refusal = [&](const std::string& more) {
    const Outcome run = calibrate("--output " + file("no.toml") + " " + more);
    EXPECT_EQ(run.exit_code, 2) << more;
    EXPECT_EQ(count_lines(run.err), 1u) << run.err;
    return run.err;
  };
  EXPECT_THAT(refusal("--length 4,8,0.1"), HasSubstr("SENSOR,SENSOR,METRES,SIGMA"));
  EXPECT_THAT(refusal("--length 4,8,128.8,0.02"), HasSubstr("millimetres"));
  EXPECT_THAT(refusal("--length 4,4,0.1,0.001"), HasSubstr("two different"));
  EXPECT_THAT(refusal("--length 4,20,0.1,0.001"), HasSubstr("no sensor 20"));
  EXPECT_THAT(refusal("--length " + length(4, 8, 0.003)), HasSubstr("contradicts"));
  EXPECT_THAT(refusal("--residuals " + file("no.toml")), HasSubstr("is the same file or folder as --residuals"));
  const Outcome flown = pharos("calibrate lighthouse " + file("flight/edges.csv.gz") + " --target " +
                               file("flight/target.csv") + " --output " + file("no.toml"));
  EXPECT_EQ(flown.exit_code, 2);
  EXPECT_THAT(pharos("calibrate").err, HasSubstr("lighthouse"));
}

TEST_F(CliCalibrate, TheFileOfAnotherTargetOrStationIsRefused) {
  std::string fewer = content_of(file("flight/target.csv"));
  fewer = fewer.substr(0, fewer.rfind("\n11,") + 1);
  const auto track = [&](const std::string& target, const std::string& calibration) {
    return pharos("track " + file("flight/edges.csv.gz") + " --target " + target + " --calibration " + calibration);
  };
  const Outcome other_target = track(folder_->write("fewer.csv", fewer), file("cal.toml"));
  EXPECT_EQ(other_target.exit_code, 2);
  EXPECT_THAT(other_target.err, HasSubstr("another target: its sensor 11"));
  std::string text = content_of(file("cal.toml"));
  for (std::size_t at; (at = text.find("BEC08E38")) != std::string::npos;) text.replace(at, 8, "0BADCAFE");
  const Outcome other_station = track(file("flight/target.csv"), folder_->write("other.toml", text));
  EXPECT_EQ(other_station.exit_code, 2);
  EXPECT_THAT(other_station.err, HasSubstr("other stations: BEC08E38"));
}

}  // namespace
}  // namespace pharos::cli_test
