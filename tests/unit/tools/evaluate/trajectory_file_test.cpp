// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/trajectory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::evaluate {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using File = TrajectoryFile<EstimatePose>;

File read(const std::string& text, const TrajectoryChoice& choice = {}) {
  return read_trajectory<EstimatePose>(pharos::test::TemporaryFile(text).path(), choice);
}

void expect_refused(const std::string& text, const std::string& why) {
  EXPECT_THAT([&] { read(text); }, ThrowsMessage<host::InputError>(HasSubstr(why))) << text;
}

constexpr const char* kHeader = "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";

TEST(TrajectoryFile, TumAndTableSayTheSame) {
  const File tum = read("# timestamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0.6 0 0.8\n2.5\t4 5 6 0 0 0 1\n");
  const File table = read(std::string(kHeader) + "1.5,0.8,0,0.6,0,1,2,3\n2.5,1,0,0,0,4,5,6\n");
  ASSERT_EQ(tum.samples.size(), 2u);
  ASSERT_EQ(table.samples.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(tum.samples[i].time_s, table.samples[i].time_s);
    EXPECT_TRUE(tum.samples[i].pose.R.isApprox(table.samples[i].pose.R));
    EXPECT_EQ(tum.samples[i].pose.t, table.samples[i].pose.t);
  }
}

// w first, times in ns, ignored columns, line ends as in the data set.
TEST(TrajectoryFile, EurocGroundTruthSaysTheSame) {
  const File euroc = read(
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x\r\n"
      "1403636580838555648,1,2,3,0.8,0,0.6,0,-0.02\r\n1403636580843555328,4,5,6,1,0,0,0,0.03\r\n");
  const File tum = read("1403636580.838555648 1 2 3 0 0.6 0 0.8\n1403636580.843555328 4 5 6 0 0 0 1\n");
  ASSERT_EQ(euroc.samples.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(euroc.samples[i].time_s, tum.samples[i].time_s, 1e-6);
    EXPECT_TRUE(euroc.samples[i].pose.R.isApprox(tum.samples[i].pose.R));
    EXPECT_EQ(euroc.samples[i].pose.t, tum.samples[i].pose.t);
  }
  expect_refused("#timestamp\n1403636580838555648,1,2,3,0.8,0,0.6\n", "8 numbers");
  expect_refused("#timestamp\n1.5,1,2,3,0.8,0,0.6,0\n", "nanoseconds");
  expect_refused("#timestamp\n1403636580838555648,1,2,x,0.8,0,0.6,0\n", "'x' is not a number");
}

// A comment with commas does not change the format of a TUM file.
TEST(TrajectoryFile, TumMayHaveAnyComment) {
  EXPECT_EQ(read("# timestamp, tx, ty, tz, qx, qy, qz, qw\n1.5 1 2 3 0 0.6 0 0.8\n").samples.size(), 1u);
}

TEST(TrajectoryFile, CountsWhatItLeavesOut) {
  const std::string text =
      "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status,flags\n"
      "1,0,1,0,0,0,0,0,2,0.1,2,ok,\n"
      "2,0,,,,,,,,,,refused_too_few_sensors,\n"
      "3,0,1,0,0,0,0,0,2,0.1,2,ambiguous,\n"
      "4,0,1,0,0,0,0,0,2,0.1,2,ok,outliers|prior\n";
  TrajectoryChoice choice;
  File file = read(text, choice);
  EXPECT_EQ(file.rows, 4u);
  EXPECT_EQ(file.refused, 1u);
  EXPECT_EQ(file.ambiguous, 1u);
  EXPECT_EQ(file.samples.size(), 2u);
  EXPECT_NEAR(*file.samples[0].sigma_rotation_rad, 0.1 * kRadPerDeg, 1e-15);
  EXPECT_NEAR(*file.samples[0].sigma_position_m, 0.002, 1e-15);
  choice.keep_ambiguous = true;
  choice.without_flags = {"prior"};
  file = read(text, choice);
  EXPECT_EQ(file.ambiguous, 0u);
  EXPECT_EQ(file.flagged, 1u);
  EXPECT_EQ(file.samples.size(), 2u);
}

TEST(TrajectoryFile, WantsOneStation) {
  const std::string text =
      "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m\n1,0,1,0,0,0,0,0,2\n1.001,1,1,0,0,0,0,0,3\n2,0,1,0,0,0,0,0,2\n";
  expect_refused(text, "--station");
  TrajectoryChoice choice;
  choice.station = 1;
  const File file = read(text, choice);
  ASSERT_EQ(file.samples.size(), 1u);
  EXPECT_EQ(file.samples[0].pose.t.z(), 3.0);
}

// pharos track --sweeps: the sweeps of two stations may end at one time.
TEST(TrajectoryFile, StationsOfOneWorldAreOneTrajectory) {
  const std::string text =
      "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m,status,cov_xx_m2\n1,0,1,0,0,0,0,0,2,ok,1e-6\n"
      "1,1,1,0,0,0,0,0,3,ok,1e-6\n1.5,1,,,,,,,,refused_poor_fit,\n2,0,1,0,0,0,0,0,4,ok,1e-6\n";
  const File file = read(text);
  ASSERT_EQ(file.samples.size(), 2u);
  EXPECT_EQ(file.samples[0].pose.t.z(), 3.0);
  EXPECT_EQ(file.samples[1].pose.t.z(), 4.0);
  EXPECT_EQ(file.rows, 3u);
  EXPECT_EQ(file.refused, 1u);
  TrajectoryChoice choice;
  choice.station = 0;
  EXPECT_EQ(read(text, choice).samples[0].pose.t.z(), 2.0);
  expect_refused(text + "1.9,1,1,0,0,0,0,0,5,ok,1e-6\n", "its time is not later");
}

// A tracker that writes two updates within the last digit of its clock.
TEST(TrajectoryFile, TakesAPoseThatWasWrittenTwiceOnce) {
  const File file =
      read(std::string(kHeader) + "1,1,0,0,0,1,2,3\n2,1,0,0,0,1,2,3\n2,1,0.0001,0,0,1,2,3.00001\n3,1,0,0,0,1,2,3\n");
  ASSERT_EQ(file.samples.size(), 3u);
  EXPECT_EQ(file.samples[1].pose.t.z(), 3.0);
  EXPECT_EQ(file.rows, 3u);
  EXPECT_EQ(file.repeated, 1u);
}

TEST(TrajectoryFile, CountsFramesAsTimeWhereThereIsNone) {
  TrajectoryChoice choice;
  choice.frame_rate_hz = 4.0;
  const File file = read("frame,tx_m,ty_m,tz_m,qw,qx,qy,qz,status\n2,0,0,3,1,0,0,0,ok\n", choice);
  ASSERT_EQ(file.samples.size(), 1u);
  EXPECT_EQ(file.samples[0].time_s, 0.5);
}

TEST(TrajectoryFile, RefusesWhatItCannotTrust) {
  const std::string header = kHeader;
  expect_refused("", "empty");
  expect_refused(header + "1,0.8,0,0.5,0,1,2,3\n", "line 2: the quaternion has length 0.94");
  expect_refused(header + "1,0,0,0,0,1,2,3\n", "length 0.0");
  expect_refused(header + "2,1,0,0,0,1,2,3\n1,1,0,0,0,1,2,3\n", "line 3: its time is not later");
  expect_refused(header + "2,1,0,0,0,1,2,3\n2,1,0,0,0,1,2,3.001\n", "line 3: its time is not later");
  expect_refused(header + "2,1,0,0,0,1,2,3\n2,0.99995,0.01,0,0,1,2,3\n", "line 3: its time is not later");
  expect_refused(header + "1,1,0,0,0,1,2,4e7\n", "metres");
  expect_refused(header + "nan,1,0,0,0,1,2,3\n", "line 2");
  expect_refused("1 2 3 0 0 0 1\n", "8 numbers");
  expect_refused("1 2 3 4 0 0 0 1 9\n", "8 numbers");
  expect_refused("1 2 3 x 0 0 0 1\n", "'x' is not a number");
  expect_refused("1 2 3 inf 0 0 0 1\n", "not a number");
  expect_refused("time_s,qw,qx\n1,1,0\n", "no column 'qy'");
}

}  // namespace
}  // namespace pharos::evaluate
