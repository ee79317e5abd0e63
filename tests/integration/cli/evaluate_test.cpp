// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/table/pose_table.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Differences of motion capture and track: frame, marker body, clock.
struct CaptureFrame {};
struct MarkerBody {};
const Pose<frame::Lighthouse, CaptureFrame> kFrame = {rotation_exp({-1.4620, 1.3741, -1.0023}), {0.680, 0.624, 2.884}};
const Pose<MarkerBody, frame::Body> kMarkers = {rotation_exp({0.3, -0.2, 0.5}), {0.05, -0.03, 0.04}};
constexpr double kClock_s = 1234.56789;
constexpr std::size_t kStep = 16;  // of the truth's milliseconds: 62.5 Hz

/// A simulated manoeuvre, its track and its motion capture.
struct Experiment {
  Folder folder;
  std::string poses = folder.path("poses.csv");
  std::string truth = folder.path("out/truth.csv");
  std::string capture;

  Experiment() {
    const std::string scenario = folder.write(
        "scenario.toml", "duration_s = 15\ntarget = \"" + folder.write("solid.csv", solid_target_csv()) +
                             "\"\n[[station]]\ncalibration = \"typical\"\n[trajectory]\nkind = \"manoeuvre\"\n");
    const Outcome made = pharos("sim lighthouse " + scenario + " --seed 3 --output " + folder.path("out"));
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const Outcome tracked = pharos("track " + folder.path("out/edges.csv.gz") + " --method epoch --target " +
                                   folder.path("out/target.csv") + " --output " + poses);
    EXPECT_EQ(tracked.exit_code, 0) << tracked.err;
    capture = folder.write("capture.csv", captured());
  }

  std::string captured() const {
    std::string text = "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";
    const auto rows = host::read_poses(truth, "time_s");
    for (std::size_t i = 0; i < rows.size(); i += kStep) {
      const auto pose = kFrame.inverse() * *rows[i].T_lighthouse_body * kMarkers.inverse();
      const Quaternion q = pose.quaternion();
      text += std::to_string(std::stod(rows[i].key) + kClock_s);
      for (const double v : {q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()}) {
        text += "," + std::to_string(v);
      }
      text += "\n";
    }
    return text;
  }
  static const Experiment& get() {
    static const Experiment experiment;
    return experiment;
  }
};

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

TEST(CliEvaluate, FindsWhatMotionCaptureDoesNotShareAndThenTheSameErrors) {
  const Experiment& e = Experiment::get();
  const std::string picture = e.folder.path("errors.svg");
  const Outcome direct = pharos("evaluate " + e.poses + " " + e.truth);
  ASSERT_EQ(direct.exit_code, 0) << direct.err;
  const Outcome found =
      pharos("evaluate " + e.poses + " " + e.capture + " --align hand-eye --time-offset auto --plot " + picture);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Row truth = rows_of(direct.out).at(0);
  const Row row = rows_of(found.out).at(0);
  EXPECT_NEAR(number(row, "time_offset_s"), kClock_s, 0.005);
  EXPECT_NEAR(number(row, "body_tx_m"), kMarkers.t.x(), 0.01);
  EXPECT_NEAR(number(row, "body_ty_m"), kMarkers.t.y(), 0.01);
  EXPECT_NEAR(number(row, "body_tz_m"), kMarkers.t.z(), 0.01);
  EXPECT_EQ(row.at("compared"), truth.at("compared"));
  for (const char* column : {"rot_rms_deg", "rot_median_deg", "pos_rms_mm", "pos_median_mm"}) {
    EXPECT_NEAR(number(row, column) / number(truth, column), 1.0, 0.2) << column;
  }
  EXPECT_EQ(row.at("open"), "");
  EXPECT_THAT(content_of(picture), StartsWith("<svg"));
}

// Its own row of an alignment read back: nothing is fitted again, and the errors are the same.
TEST(CliEvaluate, AKnownTransformIsTakenAsItIs) {
  const Experiment& e = Experiment::get();
  const std::string command = "evaluate " + e.poses + " " + e.capture + " --time-offset auto ";
  const Outcome fitted = pharos(command + "--align hand-eye");
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  const Outcome known = pharos(command + "--transform " + e.folder.write("known.csv", fitted.out));
  ASSERT_EQ(known.exit_code, 0) << known.err;
  const Row one = rows_of(fitted.out).at(0), other = rows_of(known.out).at(0);
  EXPECT_EQ(other.at("align"), "known");
  EXPECT_EQ(other.at("compared"), one.at("compared"));
  for (const char* column : {"rot_rms_deg", "pos_rms_mm"}) {
    EXPECT_NEAR(number(other, column) / number(one, column), 1.0, 0.01) << column;
  }
}

// Paper 002's own form, psi_0: of no turn and no shift it is no alignment; 30 mm along x are 30 mm of error.
TEST(CliEvaluate, ATransformInThePapersFormIsPsi) {
  const Experiment& e = Experiment::get();
  const std::string command = "evaluate " + e.poses + " " + e.truth + " ";
  const auto with = [&](const std::string& x_mm) {
    const std::string psi =
        e.folder.write("psi.csv", "phi_x_rad,phi_y_rad,phi_z_rad,x_mm,y_mm,z_mm\n0,0,0," + x_mm + ",0,0\n");
    return rows_of(pharos(command + "--transform " + psi).out).at(0);
  };
  const Row none = rows_of(pharos(command + "--align none").out).at(0), same = with("0"), shifted = with("30");
  for (const char* column : {"rot_rms_deg", "pos_rms_mm", "compared"}) EXPECT_EQ(same.at(column), none.at(column));
  EXPECT_EQ(shifted.at("rot_rms_deg"), none.at("rot_rms_deg"));
  EXPECT_NEAR(number(shifted, "pos_median_mm"), 30.0, 10.0);
}

TEST(CliEvaluate, ATransformThatIsNoneIsWrongInput) {
  const Experiment& e = Experiment::get();
  const std::string command = "evaluate " + e.poses + " " + e.truth + " --transform ";
  const std::string header = "qw,qx,qy,qz,tx_m,ty_m,tz_m\n", row = "1,0,0,0,0,0,0\n";
  EXPECT_EQ(pharos(command + e.folder.write("one.csv", header + row)).exit_code, 0);
  for (const std::string& text : {header, header + row + row, header + "2,0,0,0,0,0,0\n", std::string("a,b\n1,2\n")}) {
    EXPECT_EQ(pharos(command + e.folder.write("bad.csv", text)).exit_code, 2) << text;
  }
  EXPECT_EQ(pharos(command + e.folder.path("one.csv") + " --align se3").exit_code, 2);
}

TEST(CliEvaluate, CountsEveryRowOnce) {
  const Experiment& e = Experiment::get();
  const Row row = rows_of(pharos("evaluate " + e.poses + " " + e.truth).out).at(0);
  double sum = 0.0;
  for (const char* outcome : {"compared", "refused", "ambiguous", "flagged", "outside", "in_gap"})
    sum += number(row, outcome);
  EXPECT_EQ(sum, number(row, "rows"));
  EXPECT_EQ(rows_of(content_of(e.poses)).size(), number(row, "rows"));
}

TEST(CliEvaluate, ATableForPeopleTellsTheSameFigures) {
  const Experiment& e = Experiment::get();
  const std::string command = "evaluate " + e.poses + " " + e.truth;
  const Row row = rows_of(pharos(command).out).at(0);
  const Outcome run = pharos(command + " --table");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string& text :
       {row.at("compared") + " of " + row.at("rows") + " rows compared", row.at("pos_max_mm").substr(0, 3),
        std::string("root mean square"), std::string(" mm\n"), std::string("within 2 stated sigma")}) {
    EXPECT_THAT(run.out, HasSubstr(text));
  }
  const Outcome none = pharos("evaluate " + e.poses + " " + e.capture + " --table");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.out, HasSubstr("no result: refused_no_overlap"));
  EXPECT_EQ(pharos(command + " --table --json").exit_code, 2);
}

TEST(CliEvaluate, EndsWith1AndARowWhereTimesDoNotMeet) {
  const Experiment& e = Experiment::get();
  const Outcome run = pharos("evaluate " + e.poses + " " + e.capture);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("--time-offset auto"));
  EXPECT_EQ(rows_of(run.out).at(0).at("status"), "refused_no_overlap");
  EXPECT_EQ(rows_of(run.out).at(0).at("pos_rms_mm"), "");
}

TEST(CliEvaluate, EndsWith2OnFilesThatAreNoTrajectories) {
  const Experiment& e = Experiment::get();
  EXPECT_EQ(pharos("evaluate " + e.poses + " " + e.folder.path("solid.csv")).exit_code, 2);
  EXPECT_EQ(pharos("evaluate - -").exit_code, 2);
  EXPECT_EQ(pharos("evaluate " + e.poses + " " + e.truth + " --time-offset soon").exit_code, 2);
}

}  // namespace
}  // namespace pharos::cli_test
