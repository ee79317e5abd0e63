// SPDX-License-Identifier: Apache-2.0
#include "tools/support/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::tools {
namespace {

using ::testing::HasSubstr;

class CalibrationFileTest : public ::testing::Test {
 protected:
  CalibrationFile read(const std::string& text) const {
    file_.write(text);
    return CalibrationFile(file_.path());
  }
  std::string error_of(const std::string& text) const {
    return pharos::test::error_of([&] { read(text); });
  }
  pharos::test::TemporaryFile file_;
};

TEST_F(CalibrationFileTest, FindsStationsByIdAndBySlot) {
  const CalibrationFile file = read(
      "[[station]]\nid = \"BEC08E38\"\nphase_rad = [0.01, 0.02]\n\n"
      "[[station]]\nslot = 1\ntilt_rad = [0.003, -0.004]\ngibbous_phase_rad = [1.5, -3.0]\n");
  const tracking::StationSurvey survey = file.survey();
  ASSERT_NE(survey.find(0, 0xBEC08E38u), nullptr);
  EXPECT_EQ(survey.find(0, 0xBEC08E38u)->rotor[1].phase_rad, 0.02);
  EXPECT_EQ(survey.find(0, 0xBEC08E38u)->rotor[1].tilt_rad, 0.0);
  EXPECT_EQ(survey.find(0, 0x12345678u), nullptr);
  EXPECT_EQ(survey.find(0, std::nullopt), nullptr);
  ASSERT_NE(survey.find(1, std::nullopt), nullptr);
  EXPECT_EQ(survey.find(1, 0xBEC08E38u)->rotor[0].tilt_rad, 0.003);  // the slot has priority over the id
  EXPECT_EQ(survey.pair, nullptr);
}

TEST_F(CalibrationFileTest, AFileWithoutStationsIsAMistake) { EXPECT_THAT(error_of(""), HasSubstr("no [[station]]")); }

}  // namespace
}  // namespace pharos::tools
