// SPDX-License-Identifier: Apache-2.0
#include "tools/support/words.hpp"

#include <gtest/gtest.h>

#include <array>

#include "pharos/lighthouse/sweep.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tools {
namespace {

TEST(Words, JoinFlagsWithBars) {
  EXPECT_EQ(sweep_flag_words(0), "");
  EXPECT_EQ(sweep_flag_words(lighthouse::kSweepFlashWeak), "flash_weak");
  EXPECT_EQ(sweep_flag_words(lighthouse::kSweepFlashWeak | lighthouse::kSweepLockPoor), "flash_weak|lock_poor");
  EXPECT_EQ(epoch_flag_words(track::kEpochUncalibrated | track::kEpochOutliers), "uncalibrated|outliers");
}

TEST(Words, HaveOneForEveryFlag) {
  for (unsigned bit = 1; bit <= lighthouse::kSweepLockPoor; bit <<= 1) EXPECT_NE(sweep_flag_words(bit), "") << bit;
  for (unsigned bit = 1; bit <= track::kEpochResidualHigh; bit <<= 1) EXPECT_NE(epoch_flag_words(bit), "") << bit;
}

TEST(Words, PrintStationIdsAsTheyStandOnTheStation) {
  EXPECT_EQ(station_id_text(0xBEC08E38u), "BEC08E38");
  EXPECT_EQ(station_id_text(0x0AA54F65u), "0AA54F65");
  EXPECT_EQ(station_id_text(std::nullopt), "");
}

TEST(Words, PrintBytesAsHexadecimalDigits) {
  const std::array<std::uint8_t, 3> bytes = {0x06, 0x3d, 0xff};
  EXPECT_EQ(hex_text(bytes), "063dff");
}

}  // namespace
}  // namespace pharos::tools
