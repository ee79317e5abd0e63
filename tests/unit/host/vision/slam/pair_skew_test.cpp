// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pair_skew.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::slam {
namespace {

constexpr int kPoints = 200;

// Frames of points that move `moved` rows (1 sigma) and whose right images are `late`; rows have errors of half a
// pixel, and of `bent` px from one side of the image to the other.
PairSkew after(int frames, double moved, double late, double bent = 0.0) {
  PairSkew skew;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int frame = 0; frame < frames; ++frame) {
    for (int k = 0; k < kPoints; ++k) {
      const double rows = moved * normal(random), across = normal(random);
      skew.add(rows, late * rows + 0.5 * normal(random) + bent * across + 0.2);
    }
    skew.end_frame();
  }
  return skew;
}

TEST(PairSkew, ReportsTheDelayInFrames) {
  for (const double late : {-1.0, 0.0, 0.5, 1.0}) {
    const auto found = after(30, 0.5, late).frames_late();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, late, 0.1);
  }
}

// Several frames apart only points with little motion match, and they scatter more: less accurate than a tenth of a
// frame, but significant.
TEST(PairSkew, ReportsSeveralFramesToo) {
  for (const double late : {-3.0, 3.0}) {
    const auto found = after(30, 0.2, late, 0.8).frames_late();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, late, 0.5);
  }
  EXPECT_FALSE(after(30, 0.2, 0.0, 0.8).frames_late());
  EXPECT_FALSE(after(30, 0.1, 3.0, 0.8).frames_late());
}

TEST(PairSkew, RowsOffThatDoNotFollowTheMotionAreNoDelay) {
  const auto found = after(30, 1.0, 0.0, 0.5).frames_late();
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.0, 0.1);
}

TEST(PairSkew, SaysNothingWhereLittleMovedOrFewFramesWereSeen) {
  EXPECT_FALSE(after(30, 0.1, 1.0).frames_late());
  EXPECT_FALSE(after(5, 1.0, 1.0).frames_late());
  EXPECT_FALSE(PairSkew().frames_late());
}

TEST(PairSkew, ForgetsWhatWasMended) {
  PairSkew skew = after(40, 0.5, 1.0);
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int frame = 0; frame < 100; ++frame) {
    for (int k = 0; k < kPoints; ++k) skew.add(0.5 * normal(random), 0.5 * normal(random));
    skew.end_frame();
  }
  ASSERT_TRUE(skew.frames_late());
  EXPECT_NEAR(*skew.frames_late(), 0.0, 0.15);
}

}  // namespace
}  // namespace pharos::slam
