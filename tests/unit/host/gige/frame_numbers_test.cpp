// SPDX-License-Identifier: Apache-2.0
#include "host/gige/frame_numbers.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

TEST(FrameNumbers, CountsGapsAndNothingBeforeTheFirst) {
  FrameNumbers numbers;
  EXPECT_EQ(numbers.missing_before(700), 0);
  EXPECT_EQ(numbers.missing_before(701), 0);
  EXPECT_EQ(numbers.missing_before(705), 3);
}

TEST(FrameNumbers, GoRoundFrom65535To1WithoutALoss) {
  FrameNumbers numbers;
  numbers.missing_before(65'534);
  EXPECT_EQ(numbers.missing_before(65'535), 0);
  EXPECT_EQ(numbers.missing_before(1), 0);
  EXPECT_EQ(numbers.missing_before(2), 0);
  numbers.missing_before(65'533);
  FrameNumbers others;
  others.missing_before(65'533);
  EXPECT_EQ(others.missing_before(2), 3) << "65534, 65535 and 1";
}

TEST(FrameNumbers, OfExtendedIdsGoOnBeyond16Bits) {
  FrameNumbers numbers;
  numbers.missing_before(65'535);
  EXPECT_EQ(numbers.missing_before(65'536), 0);
  EXPECT_EQ(numbers.missing_before(65'540), 3);
}

TEST(FrameNumbers, ALateFrameIsNoLossAndChangesNothing) {
  FrameNumbers numbers;
  numbers.missing_before(10);
  EXPECT_EQ(numbers.missing_before(12), 1);
  EXPECT_EQ(numbers.missing_before(11), 0);
  EXPECT_EQ(numbers.missing_before(13), 0);
}

}  // namespace
}  // namespace pharos::host
