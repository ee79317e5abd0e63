// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/calibration_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using lighthouse::StationCalibration;
using ::testing::ElementsAre;

class CalibrationMemoryTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  std::vector<StationCalibration> reread() const {
    CalibrationMemory memory(folder_);
    memory.load();
    return memory.stations();
  }
  fs::path folder_ =
      fs::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name() / "state";
};

// Values that no short decimal hits, of real size.
StationCalibration station(std::uint32_t id, double scale = 1.0) {
  StationCalibration calibration;
  calibration.id = id;
  calibration.rotor[0] = {scale / 64.1, -scale / 3333.0, scale / 555.0, -scale / 3.0, scale / 235.0};
  calibration.rotor[1] = {scale / 26.2, scale / 445.0, -scale / 585.0, -1.5, 0.0};
  return calibration;
}

TEST_F(CalibrationMemoryTest, ReadsBackExactlyWhatWasKept) {
  CalibrationMemory memory(folder_);
  EXPECT_EQ(memory.keep(station(0xBEC08E38)), std::nullopt);
  EXPECT_EQ(memory.keep(station(0x00000001, 0.5)), std::nullopt);
  EXPECT_THAT(reread(), ElementsAre(station(0xBEC08E38), station(1, 0.5)));
}

TEST_F(CalibrationMemoryTest, ANewCalibrationReplacesTheOldOneOfTheSameStation) {
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.keep(station(8));
  memory.keep(station(7, 0.9));
  EXPECT_THAT(reread(), ElementsAre(station(7, 0.9), station(8)));
}

TEST_F(CalibrationMemoryTest, NothingThereIsAnEmptyMemory) { EXPECT_TRUE(reread().empty()); }

TEST_F(CalibrationMemoryTest, ADamagedFileIsToldAndThenReplaced) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "stations.toml") << "[[station]]\nid = \"XYZ\"\n";
  CalibrationMemory memory(folder_);
  EXPECT_THROW(memory.load(), InputError);
  EXPECT_TRUE(memory.stations().empty());
  EXPECT_EQ(memory.keep(station(7)), std::nullopt);
  EXPECT_THAT(reread(), ElementsAre(station(7)));
}

TEST_F(CalibrationMemoryTest, SaysWhyItCannotBeWrittenAndKeepsItInMemory) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_.string()) << "a file where the folder should be";
  CalibrationMemory memory(folder_);
  const auto error = memory.keep(station(7));
  ASSERT_TRUE(error.has_value());
  EXPECT_THAT(*error, ::testing::HasSubstr("stations.toml: cannot be written"));
  EXPECT_THAT(memory.stations(), ElementsAre(station(7)));
}

TEST_F(CalibrationMemoryTest, WithoutADirectoryNothingIsWritten) {
  CalibrationMemory memory("");
  EXPECT_EQ(memory.keep(station(7)), std::nullopt);
  EXPECT_THAT(memory.stations(), ElementsAre(station(7)));
}

}  // namespace
}  // namespace pharos::host
