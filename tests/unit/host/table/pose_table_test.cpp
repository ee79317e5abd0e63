// SPDX-License-Identifier: Apache-2.0
#include "host/table/pose_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::error_of;
using pharos::test::TemporaryFile;
using ::testing::HasSubstr;

TEST(ReadPoses, ReadsRotationsAndRefusedRows) {
  const TemporaryFile file(
      "pose,qw,qx,qy,qz,tx_m,ty_m,tz_m,status\nhome,0.70710678,0,0,0.70710678,1,2,3,ok\n8,,,,,,,,refused_poor_fit\n");
  const auto rows = read_poses(file.path(), "pose");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].key, "home");
  ASSERT_TRUE(rows[0].T_lighthouse_body);
  // A quarter turn about z takes x to y.
  EXPECT_LT((*rows[0].T_lighthouse_body * Vector3::UnitX() - Vector3(1, 3, 3)).norm(), 1e-12);
  EXPECT_FALSE(rows[1].T_lighthouse_body);
}

TEST(ReadPoses, RefusesWhatIsNoRotation) {
  const TemporaryFile file("time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m\n0.5,1,1,0,0,1,2,3\n");
  EXPECT_THAT(error_of([&] { read_poses(file.path(), "time_s"); }), HasSubstr("length 1.41"));
}

TEST(ReadPoses, RefusesHalfAPose) {
  const TemporaryFile file("pose,qw,qx,qy,qz,tx_m,ty_m,tz_m\n1,1,0,0,0,1,,3\n");
  EXPECT_THAT(error_of([&] { read_poses(file.path(), "pose"); }), HasSubstr("'ty_m'"));
}

}  // namespace
}  // namespace pharos::host
