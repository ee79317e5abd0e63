// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/truth_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::tools {
namespace {

using ::testing::HasSubstr;

class TruthFileTest : public ::testing::Test {
 protected:
  void write(const std::string& text) {
    out_ << text;
    out_.flush();
  }
  std::string error_of(const std::string& text) {
    write(text);
    return pharos::test::error_of([&] { TruthFile(path_).at(0, 0); });
  }
  std::string path_ = ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  std::ofstream out_{path_};
};

constexpr const char* kHeader = "utime,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";

TEST_F(TruthFileTest, InterpolatesPositionLinearlyAndRotationAtConstantRate) {
  write(std::string(kHeader) + "1000,1,0,0,0,0,0,3\n2000,0.7071067811865476,0,0.7071067811865476,0,1,0,5\n");
  TruthFile truth(path_);
  const auto pose = truth.at(0, 1250);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((pose->t - Vector3(0.25, 0.0, 3.5)).norm(), 1e-12);
  EXPECT_LT((rotation_log(pose->R) - Vector3(0.0, kPi / 8.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(truth.at(0, 2000)->t.x(), 1.0);
}

TEST_F(TruthFileTest, KnowsNothingOutsideItsRows) {
  write(std::string(kHeader) + "1000,1,0,0,0,0,0,3\n2000,1,0,0,0,0,0,3\n");
  TruthFile truth(path_);
  EXPECT_FALSE(truth.at(0, 999).has_value());
  EXPECT_FALSE(truth.at(0, 2001).has_value());
  EXPECT_FALSE(truth.at(1, 1500).has_value());
  EXPECT_FALSE(truth.at(7, 1500).has_value());
}

TEST_F(TruthFileTest, FollowsAFileThatIsStillBeingWritten) {
  write("utime,qw,qx,qy");
  TruthFile truth(path_);
  EXPECT_FALSE(truth.at(0, 1500).has_value());
  write(",qz,tx_m,ty_m,tz_m\n1000,1,0,0,0,0,0,3\n2000,1,0,0,");
  EXPECT_FALSE(truth.at(0, 1500).has_value());
  write("0,0,0,5\n");
  ASSERT_TRUE(truth.at(0, 1500).has_value());
  EXPECT_EQ(truth.at(0, 1500)->t.z(), 4.0);
}

TEST_F(TruthFileTest, KeepsStationsApartAndTakesSecondsOfUtc) {
  write(
      "time_s,station,qw,qx,qy,qz,tx_m,ty_m,tz_m\n"
      "1700000000.000,0,1,0,0,0,1,0,3\n1700000000.000,1,1,0,0,0,2,0,3\n"
      "1700000000.001,0,1,0,0,0,1,0,3\n1700000000.001,1,1,0,0,0,2,0,3\n");
  TruthFile truth(path_);
  EXPECT_EQ(truth.at(0, 1'700'000'000'000'500)->t.x(), 1.0);
  EXPECT_EQ(truth.at(1, 1'700'000'000'000'500)->t.x(), 2.0);
}

TEST_F(TruthFileTest, RefusesTimesOfARecordingsOwnCounter) {
  EXPECT_THAT(error_of("time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m\n0.5,1,0,0,0,0,0,3\n"), HasSubstr(":2: time_s is not UTC"));
}

TEST_F(TruthFileTest, NamesTheLineThatCannotBeRead) {
  EXPECT_THAT(error_of(std::string(kHeader) + "1000,1,0,0,0,0,0,3\n2000,nan,0,0,0,0,0,3\n"), HasSubstr(".csv:3: "));
}

TEST_F(TruthFileTest, RefusesAHeaderWithoutAPose) {
  EXPECT_THAT(error_of("utime,x\n1,2\n"), HasSubstr(":1: no column qw"));
}

TEST_F(TruthFileTest, RefusesAQuaternionThatIsNone) {
  EXPECT_THAT(error_of(std::string(kHeader) + "1000,0,0,0,0,0,0,3\n"), HasSubstr("quaternion"));
}

TEST_F(TruthFileTest, RefusesTimesThatDoNotGrow) {
  EXPECT_THAT(error_of(std::string(kHeader) + "1000,1,0,0,0,0,0,3\n1000,1,0,0,0,0,0,3\n"), HasSubstr("must grow"));
}

}  // namespace
}  // namespace pharos::tools
