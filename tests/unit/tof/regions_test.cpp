// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/regions.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace pharos::tof {
namespace {

class Regions : public testing::Test {
 protected:
  void fill(int left, int top, int right, int bottom) {
    for (int v = top; v <= bottom; ++v) {
      for (int u = left; u <= right; ++u) mask_->set(u, v);
    }
  }
  std::unique_ptr<BitImage> mask_ = std::make_unique<BitImage>();
  std::unique_ptr<RegionWorkspace> workspace_ = std::make_unique<RegionWorkspace>();
  Region region_;
};

TEST_F(Regions, CornersDoNotJoinFourNeighbours) {
  mask_->reset(40, 30);
  fill(5, 5, 9, 9);
  fill(10, 10, 14, 14);
  ASSERT_TRUE(grow_region(*mask_, 7, 7, *workspace_, region_));
  EXPECT_EQ(region_.area_px, 25);
  EXPECT_EQ(region_.right, 9);
  EXPECT_DOUBLE_EQ(region_.u_px, 7.0);
  EXPECT_DOUBLE_EQ(region_.v_px, 7.0);
  EXPECT_FALSE(mask_->at(7, 7)) << "taken out";
  EXPECT_TRUE(mask_->at(12, 12)) << "left for later";
}

TEST_F(Regions, OutlineIsKeptByRowsAndColumns) {
  mask_->reset(40, 30);
  fill(5, 5, 20, 6);  // an L
  fill(5, 7, 7, 12);
  ASSERT_TRUE(grow_region(*mask_, 20, 5, *workspace_, region_));
  EXPECT_EQ(region_.rows(), 8);
  EXPECT_EQ(region_.row[0].last, 20);
  EXPECT_EQ(region_.row[7].first, 5);
  EXPECT_EQ(region_.row[7].last, 7);
  EXPECT_EQ(region_.column[0].last, 12);
  EXPECT_EQ(region_.column[15].last, 6);
}

TEST_F(Regions, WhatSpansTooMuchIsTakenOutWithoutOutline) {
  mask_->reset(kMaxRegionSide_px + 10, 3);
  fill(0, 1, kMaxRegionSide_px + 1, 1);
  EXPECT_FALSE(grow_region(*mask_, 3, 1, *workspace_, region_));
  EXPECT_EQ(region_.area_px, kMaxRegionSide_px + 2);
  EXPECT_FALSE(mask_->at(0, 1));
}

TEST_F(Regions, TheWholeImageFitsTheWorkspace) {
  mask_->reset(kMaxWidth_px, kMaxHeight_px);
  fill(0, 0, kMaxWidth_px - 1, kMaxHeight_px - 1);
  EXPECT_FALSE(grow_region(*mask_, 0, 0, *workspace_, region_));
  EXPECT_EQ(region_.area_px, kMaxPixels);
}

TEST_F(Regions, ASeedThatIsNotSetGivesNothing) {
  mask_->reset(10, 10);
  EXPECT_FALSE(grow_region(*mask_, 3, 3, *workspace_, region_));
  EXPECT_EQ(region_.area_px, 0);
}

}  // namespace
}  // namespace pharos::tof
