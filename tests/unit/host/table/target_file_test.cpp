// SPDX-License-Identifier: Apache-2.0
#include "host/table/target_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::error_of;
using pharos::test::TemporaryFile;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSolid = "sensor,x_m,y_m,z_m\n0,0,0,0\n7,0.1,0,0\n3,0,0.1,0\n4,0,0,0.1\n";

TargetFile read_content(const std::string& content) { return read_target(TemporaryFile(content).path()); }
std::string target_error(const std::string& content) {
  return error_of([&] { read_content(content); });
}

TEST(ReadTarget, TakesSensorsInAnyOrderWithGaps) {
  const TargetFile file = read_content(kSolid);
  ASSERT_EQ(file.target.size(), 4u);
  ASSERT_NE(find_sensor(file.target, 7), nullptr);
  EXPECT_EQ(find_sensor(file.target, 7)->position_m, Vector3(0.1, 0, 0));
  EXPECT_FALSE(find_sensor(file.target, 7)->has_normal());
  EXPECT_FALSE(file.shape.coplanar);
}

TEST(ReadTarget, TakesNormalsWhereKnown) {
  const TargetFile file =
      read_content("sensor,x_m,y_m,z_m,nx,ny,nz\n0,0,0,0,0,0,1\n1,0.1,0,0,,,\n2,0,0.1,0,0,0,0\n3,0,0,0.1,0.6,0.8,0\n");
  EXPECT_TRUE(find_sensor(file.target, 0)->has_normal());
  EXPECT_FALSE(find_sensor(file.target, 1)->has_normal());
  EXPECT_FALSE(find_sensor(file.target, 2)->has_normal());
  EXPECT_EQ(find_sensor(file.target, 3)->normal, Vector3(0.6, 0.8, 0));
}

TEST(ReadTarget, AllowsACoplanarTargetButMarksIt) {
  EXPECT_TRUE(read_content("sensor,x_m,y_m,z_m\n0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0.1,0.1,0\n").shape.coplanar);
}

TEST(ReadTarget, NamesBothLinesOfASensorThatStandsTwice) {
  EXPECT_THAT(target_error(std::string(kSolid) + "7,1,1,1\n"),
              AllOf(HasSubstr("line 6"), HasSubstr("sensor 7"), HasSubstr("line 3")));
}

TEST(ReadTarget, NamesTwoSensorsInOnePlace) {
  EXPECT_THAT(target_error(std::string(kSolid) + "9,0.10005,0,0\n"), HasSubstr("7 and 9"));
}

TEST(ReadTarget, RefusesMillimetresGivenByMistake) {
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n0,0,0,0\n1,5,0,0\n2,0,-62.5,0\n3,0,0,40\n"),
              AllOf(HasSubstr("line 4: column 'y_m': -62.5 m"), HasSubstr("give metres, not millimetres")));
  // A body's origin may be metres from its sensors.
  EXPECT_EQ(target_error("sensor,x_m,y_m,z_m\n0,11,0,0\n1,11.1,0,0\n2,11,0.1,0\n3,11,0,0.1\n"), "");
}

TEST(ReadTarget, RefusesWhatCannotCarryAPose) {
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n0,0,0,0\n1,1,0,0\n"), HasSubstr("fewer than three sensors"));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n0,0,0,0\n1,1,0,0\n2,2,0,0\n3,3,0,0\n"), HasSubstr("one line"));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n"), HasSubstr("fewer than three sensors"));
}

TEST(ReadTarget, RefusesWhatIsNoTarget) {
  EXPECT_THAT(target_error("sensor,x_mm,y_mm,z_mm\n0,0,0,0\n"), HasSubstr("no column 'x_m'"));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n32,0,0,0\n"), HasSubstr("0 to 31"));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m\n1,0,,0\n"), AllOf(HasSubstr("line 2"), HasSubstr("'y_m'")));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m,nx,ny\n1,0,0,0,1,0\n"), HasSubstr("nx,ny,nz"));
  EXPECT_THAT(target_error("sensor,x_m,y_m,z_m,nx,ny,nz\n1,0,0,0,1,1,0\n"), HasSubstr("length 1.41"));
}

}  // namespace
}  // namespace pharos::host
