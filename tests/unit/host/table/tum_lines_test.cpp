// SPDX-License-Identifier: Apache-2.0
#include "host/table/tum_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace pharos::host {
namespace {

RowPose at(double time_s) { return {time_s, Quaternion(0.5, 0.5, -0.5, 0.5), Vector3(0.25, -2.0, 3.5)}; }

TEST(TumLines, WritesTimePositionAndQuaternionWithWLast) {
  TumLines tum;
  EXPECT_EQ(tum.line(at(1700000000.123456)), "1700000000.123456 0.25 -2.0 3.5 0.5 -0.5 0.5 0.5\n");
  EXPECT_EQ(tum.lines(), 1U);
  EXPECT_EQ(text_of(tum.left_out()), "");
}

TEST(TumLines, LeavesOutWhatDoesNotHoldAloneAndCountsItByReason) {
  TumLines tum;
  EXPECT_EQ(tum.line(std::nullopt), "");
  RowPose pose = at(1.0);
  pose.grade = PoseGrade::kAmbiguous;
  EXPECT_EQ(tum.line(pose), "");
  pose.grade = PoseGrade::kNoTurn;
  EXPECT_EQ(tum.line(pose), "");
  pose = at(1.0);
  pose.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tum.line(pose), "");
  EXPECT_NE(tum.line(at(1.0)), "");
  EXPECT_EQ(tum.line(at(1.0)), "") << "times grow";
  EXPECT_EQ(tum.line(at(0.5)), "");
  EXPECT_EQ(tum.lines(), 1U);
  EXPECT_EQ(tum.left_out().total(), 6U);
  EXPECT_EQ(text_of(tum.left_out()),
            "6 rows have no TUM line: 1 refused, 1 ambiguous, 1 without a measured turn about their axis, 2 not later "
            "than the one before, 1 not finite");
}

TEST(TumLines, HoldsOneSeriesThatOfTheFirstGoodPose) {
  TumLines tum;
  RowPose pose = at(1.0);
  pose.series = "0";
  pose.grade = PoseGrade::kAmbiguous;
  EXPECT_EQ(tum.line(pose), "");
  pose = at(2.0);
  pose.series = "1";
  EXPECT_NE(tum.line(pose), "");
  pose.time_s = 3.0;
  pose.series = "0";
  EXPECT_EQ(tum.line(pose), "");
  EXPECT_EQ(tum.left_out().other_series, 1U);
}

TEST(TumLines, HoldsTheChosenSeries) {
  TumLines tum("1");
  RowPose pose = at(1.0);
  pose.series = "0";
  EXPECT_EQ(tum.line(pose), "");
  pose.series = "1";
  EXPECT_NE(tum.line(pose), "");
}

}  // namespace
}  // namespace pharos::host
