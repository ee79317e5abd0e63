// SPDX-License-Identifier: Apache-2.0
#include "host/stations/station_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using ::testing::HasSubstr;

class StationFileTest : public ::testing::Test {
 protected:
  std::vector<StationEntry> read(const std::string& text) const {
    file_.write(text);
    return read_station_file(file_.path());
  }
  std::string error_of(const std::string& text) const {
    return pharos::test::error_of([&] { read(text); });
  }
  pharos::test::TemporaryFile file_;
};

TEST_F(StationFileTest, ReadsBackExactlyWhatItWrites) {
  lighthouse::StationCalibration a;
  a.id = 0xBEC08E38;
  a.rotor[0] = {1.0 / 64.1, -1.0 / 3333.0, 1.0 / 555.0, -1.0 / 3.0, 1e-17};
  a.rotor[1] = {0.0, -0.0, 0.25, -3.0, 1.0 / 235.0};
  lighthouse::StationCalibration b = a;
  b.id = 7;
  const auto entries = read("# heading\n" + station_text(a) + "\n" + station_text(b));
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].id, 0xBEC08E38u);
  EXPECT_EQ(entries[0].slot, std::nullopt);
  EXPECT_EQ(entries[0].calibration, a);
  EXPECT_EQ(entries[1].calibration, b);
}

TEST_F(StationFileTest, TakesASlotForAnIdAndAbsentListsForZero) {
  const auto entries = read("[[station]]\nslot = 1\ntilt_rad = [0.003, -0.004]\n");
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].id, std::nullopt);
  EXPECT_EQ(entries[0].slot, 1);
  EXPECT_EQ(entries[0].calibration.rotor[1].tilt_rad, -0.004);
  EXPECT_EQ(entries[0].calibration.rotor[1].phase_rad, 0.0);
  EXPECT_TRUE(read("").empty());
}

TEST_F(StationFileTest, NamesLineAndKeyOfWhatItCannotUse) {
  EXPECT_THAT(error_of("[[station]]\nphase_rad = [0.01, 0.02]\n"), HasSubstr("id"));
  EXPECT_THAT(error_of("[[station]]\nid = \"HELLO\"\n"), HasSubstr(":2: station[0].id: must be up to eight hex"));
  EXPECT_THAT(error_of("[[station]]\nid = \"1\"\nphase_rad = [0.01]\n"), HasSubstr("phase_rad"));
  EXPECT_THAT(error_of("[[station]]\nid = \"1\"\nphase_rad = [1.7, 0.0]\n"), HasSubstr("phase_rad"));
  EXPECT_THAT(error_of("[[station]]\nid = \"1\"\ntlit_rad = [0.1, 0.0]\n"), HasSubstr("tlit_rad"));
  EXPECT_THAT(error_of("[[station]]\nslot = 2\n"), HasSubstr("slot"));
}

}  // namespace
}  // namespace pharos::host
