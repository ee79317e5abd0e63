// SPDX-License-Identifier: Apache-2.0
#include "host/gige/frame_numbers.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

class FrameNumbersTest : public ::testing::Test {
 protected:
  /// A frame that arrives a thirtieth of a second after the one before.
  std::optional<std::int64_t> next(std::uint64_t number) {
    return numbers.missing_before(number, arrival_ns += 33'333'333);
  }
  FrameNumbers numbers;
  std::int64_t arrival_ns = 0;
};

TEST_F(FrameNumbersTest, CountsGapsAndNothingBeforeTheFirst) {
  EXPECT_EQ(next(700), 0);
  EXPECT_EQ(next(701), 0);
  EXPECT_EQ(next(705), 3);
}

TEST_F(FrameNumbersTest, GoRoundFrom65535To1WithoutALoss) {
  next(65'534);
  EXPECT_EQ(next(65'535), 0);
  EXPECT_EQ(next(1), 0);
  EXPECT_EQ(next(2), 0);
}

TEST_F(FrameNumbersTest, CountsGapsAcrossTheRound) {
  next(65'533);
  EXPECT_EQ(next(2), 3) << "65534, 65535 and 1";
}

TEST_F(FrameNumbersTest, OfExtendedIdsGoOnBeyond16Bits) {
  next(65'535);
  EXPECT_EQ(next(65'536), 0);
  EXPECT_EQ(next(65'540), 3);
  EXPECT_EQ(next(65'539), std::nullopt) << "these do not go round";
}

TEST_F(FrameNumbersTest, ALateOrRepeatedFrameIsNoLossAndChangesNothing) {
  next(10);
  EXPECT_EQ(next(12), 1);
  EXPECT_EQ(next(11), std::nullopt);
  EXPECT_EQ(next(12), std::nullopt);
  EXPECT_EQ(next(13), 0);
}

TEST_F(FrameNumbersTest, ANumberThatTheCameraCannotHaveCountedToIsAnotherSenders) {
  next(1000);
  EXPECT_EQ(next(1100), std::nullopt);
  EXPECT_EQ(next(40'000), std::nullopt);
  EXPECT_EQ(next(std::uint64_t{1} << 60), std::nullopt);
  EXPECT_EQ(next(1001), 0);
}

TEST_F(FrameNumbersTest, AfterAPauseAsManyMayBeMissing) {
  next(1000);
  arrival_ns += 10'000'000'000;
  EXPECT_EQ(next(1301), 300);
}

}  // namespace
}  // namespace pharos::host
