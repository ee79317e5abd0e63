// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/calibration_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <string>

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

// Values of realistic size that have no short decimal representation.
StationCalibration station(std::uint32_t id, double scale = 1.0) {
  StationCalibration calibration;
  calibration.id = id;
  calibration.rotor[0] = {scale / 64.1, -scale / 3333.0, scale / 555.0, -scale / 3.0, scale / 235.0};
  calibration.rotor[1] = {scale / 26.2, scale / 445.0, -scale / 585.0, -1.5, 0.0};
  return calibration;
}

TEST_F(CalibrationMemoryTest, ReadsBackExactlyWhatWasKept) {
  CalibrationMemory memory(folder_);
  memory.keep(station(0xBEC08E38));
  memory.keep(station(0x00000001, 0.5));
  memory.save(0);
  EXPECT_EQ(memory.error(), "");
  EXPECT_THAT(reread(), ElementsAre(station(0xBEC08E38), station(1, 0.5)));
}

TEST_F(CalibrationMemoryTest, AnglesOfNoStationAreDroppedAndDoNotAffectTheOthers) {
  CalibrationMemory memory(folder_);
  memory.keep(station(0xBEC08E38));
  memory.keep(station(1, 30.0));
  memory.save(0);
  EXPECT_EQ(memory.counters().dropped, 1);
  EXPECT_THAT(reread(), ElementsAre(station(0xBEC08E38)));
}

TEST_F(CalibrationMemoryTest, KeepingWritesNothingUntilThereIsTime) {
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  EXPECT_FALSE(fs::exists(folder_));
  memory.save(0);
  EXPECT_THAT(reread(), ElementsAre(station(7)));
}

TEST_F(CalibrationMemoryTest, WhatDidNotChangeIsNotWrittenAgain) {
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.save(0);
  fs::remove(memory.file());
  memory.keep(station(7));
  memory.save(1);
  memory.save_at_last();
  EXPECT_FALSE(fs::exists(memory.file()));
}

TEST_F(CalibrationMemoryTest, ANewCalibrationReplacesTheOldOneOfTheSameStationAndIsTheNewest) {
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.keep(station(8));
  memory.keep(station(7, 0.9));
  memory.save(0);
  EXPECT_THAT(reread(), ElementsAre(station(8), station(7, 0.9)));
}

TEST_F(CalibrationMemoryTest, ManyStationIdsEvictTheOldest) {
  CalibrationMemory memory(folder_);
  constexpr auto kMax = static_cast<std::uint32_t>(CalibrationMemory::kMaxStations);
  for (std::uint32_t id = 1; id <= kMax; ++id) memory.keep(station(id));
  memory.keep(station(1));  // in use again: no longer the oldest
  EXPECT_EQ(memory.counters().dropped, 0);
  for (std::uint32_t id = 1000; id < 1010; ++id) memory.keep(station(id));
  EXPECT_EQ(memory.counters().dropped, 10);
  memory.save(0);
  const auto stations = reread();
  ASSERT_EQ(stations.size(), kMax);
  EXPECT_EQ(stations.front(), station(12));
  EXPECT_EQ(std::count(stations.begin(), stations.end(), station(1)), 1);
  EXPECT_EQ(stations.back(), station(1009));
  EXPECT_LT(fs::file_size(memory.file()), 32u * 1024u);
}

TEST_F(CalibrationMemoryTest, AFileOfMoreStationsGivesTheNewest) {
  fs::create_directories(folder_);
  {
    std::ofstream file(folder_ / "stations.toml");
    for (int id = 0; id < 70; ++id) {
      file << "[[station]]\nid = \"" << std::hex << id << std::dec << "\"\n";
      for (const char* key : {"phase_rad", "tilt_rad", "curve_rad", "gibbous_phase_rad", "gibbous_magnitude_rad"}) {
        file << key << " = [0.0, 0.0]\n";
      }
    }
  }
  CalibrationMemory memory(folder_);
  memory.load();
  EXPECT_EQ(memory.stations().size(), CalibrationMemory::kMaxStations);
  EXPECT_EQ(memory.stations().back().id, 69u);
  EXPECT_EQ(memory.counters().dropped, 6);
}

TEST_F(CalibrationMemoryTest, NothingThereIsAnEmptyMemory) { EXPECT_TRUE(reread().empty()); }

// What a power cut leaves if the file system had written the directory entry but not the content.
TEST_F(CalibrationMemoryTest, AnEmptyFileIsAnEmptyMemory) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "stations.toml") << "";
  EXPECT_TRUE(reread().empty());
}

// Each of the deep keys and arrays would overflow the stack of a recursive parser.
TEST_F(CalibrationMemoryTest, ADamagedFileIsSetAsideCountedAndThenReplaced) {
  std::string deep_key, deep_array = "a = ";
  for (int i = 0; i < 50'000; ++i) {
    deep_key += "a.";
    deep_array += '[';
  }
  for (const std::string& damaged : {std::string("[[station]]\nid = \"XYZ\"\n"), std::string("[[station]]\n"),
                                     std::string(300, '\0'), deep_key + "a = 1\n", deep_array}) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "stations.toml") << damaged;
    CalibrationMemory memory(folder_);
    EXPECT_THROW(memory.load(), InputError);
    EXPECT_TRUE(memory.stations().empty());
    EXPECT_EQ(memory.counters().damaged_files, 1);
    EXPECT_FALSE(fs::exists(folder_ / "stations.toml"));
    EXPECT_EQ(fs::file_size(folder_ / "stations.toml.damaged"), damaged.size());
    memory.keep(station(7));
    memory.save(0);
    EXPECT_THAT(reread(), ElementsAre(station(7)));
  }
}

TEST_F(CalibrationMemoryTest, WhatIsNoFileIsSetAsideWithoutWaitingForIt) {
  fs::create_directories(folder_ / "stations.toml");
  CalibrationMemory of_folder(folder_);
  EXPECT_THROW(of_folder.load(), InputError);
  fs::remove(folder_ / "stations.toml.damaged");
  ASSERT_EQ(::mkfifo((folder_ / "stations.toml").c_str(), 0600), 0);
  CalibrationMemory of_pipe(folder_);
  EXPECT_THROW(of_pipe.load(), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "stations.toml"));
}

// Whoever may write into the folder could otherwise redirect the write to another file by a symbolic link.
TEST_F(CalibrationMemoryTest, WritesThroughNoLink) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "other") << "mine";
  fs::create_symlink("other", folder_ / "stations.toml.new");
  fs::create_symlink("other", folder_ / "stations.toml");
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.save(0);
  EXPECT_EQ(fs::file_size(folder_ / "other"), 4u);
  EXPECT_THAT(reread(), ElementsAre(station(7)));
}

TEST_F(CalibrationMemoryTest, SaysWhyItCannotBeWrittenAndTriesAgainAfterAWhile) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_.string()) << "a file where the folder should be";
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.save(0);
  EXPECT_THAT(memory.error(), ::testing::HasSubstr("stations.toml: cannot be written"));
  EXPECT_THAT(memory.stations(), ElementsAre(station(7)));
  EXPECT_EQ(memory.counters().write_failures, 1);

  fs::remove(folder_);
  memory.save(CalibrationMemory::kRetry_ns - 1);
  EXPECT_THAT(memory.error(), ::testing::HasSubstr("cannot be written")) << "not at every turn of the loop";
  memory.save(CalibrationMemory::kRetry_ns);
  EXPECT_EQ(memory.error(), "");
  EXPECT_THAT(reread(), ElementsAre(station(7)));
  EXPECT_EQ(memory.counters().write_failures, 1);
}

TEST_F(CalibrationMemoryTest, AtTheEndItIsTriedWhateverTheTime) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_.string()) << "a file where the folder should be";
  CalibrationMemory memory(folder_);
  memory.keep(station(7));
  memory.save(0);
  fs::remove(folder_);
  memory.save_at_last();
  EXPECT_THAT(reread(), ElementsAre(station(7)));
}

TEST_F(CalibrationMemoryTest, WithoutADirectoryNothingIsWritten) {
  CalibrationMemory memory("");
  memory.keep(station(7));
  memory.save(0);
  EXPECT_EQ(memory.error(), "");
  EXPECT_THAT(memory.stations(), ElementsAre(station(7)));
}

}  // namespace
}  // namespace pharos::host
