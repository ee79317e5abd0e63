// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/bit_image.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace pharos::tof {
namespace {

bool at_or_clear(const BitImage& image, int u, int v) { return image.contains(u, v) && image.at(u, v); }

TEST(BitImage, ErosionAndDilationLookAtEightNeighbours) {
  for (const int width : {63, 64, 65, 130}) {
    constexpr int kHeight = 17;
    const auto image = std::make_unique<BitImage>();
    const auto eroded = std::make_unique<BitImage>();
    const auto dilated = std::make_unique<BitImage>();
    std::mt19937 random(1);
    std::bernoulli_distribution dense(0.7);
    image->reset(width, kHeight);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < width; ++u) {
        if (dense(random)) image->set(u, v);
      }
    }
    image->erode(*eroded);
    image->dilate(*dilated);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < width; ++u) {
        bool all = true;
        bool any = false;
        for (int k = 0; k < 9; ++k) {
          all = all && at_or_clear(*image, u + k % 3 - 1, v + k / 3 - 1);
          any = any || at_or_clear(*image, u + k % 3 - 1, v + k / 3 - 1);
        }
        ASSERT_EQ(eroded->at(u, v), all) << width << " at " << u << ", " << v;
        ASSERT_EQ(dilated->at(u, v), any) << width << " at " << u << ", " << v;
      }
    }
  }
}

TEST(BitImage, NextSetFindsEachInTurn) {
  for (const int width : {1, 63, 64, 65, 640}) {
    const auto image = std::make_unique<BitImage>();
    std::mt19937 random(2);
    std::bernoulli_distribution sparse(0.05);
    image->reset(width, 4);
    for (int v = 0; v < 4; ++v) {
      for (int u = 0; u < width; ++u) {
        if (sparse(random)) image->set(u, v);
      }
    }
    for (int v = 0; v < 4; ++v) {
      int next = width;
      for (int u = width; u >= 0; --u) {
        if (u < width && image->at(u, v)) next = u;
        ASSERT_EQ(image->next_set(u, v), next) << width << " from " << u << ", " << v;
      }
    }
  }
}

TEST(BitImage, OpeningDropsBurrsAndClosingFillsHoles) {
  const auto image = std::make_unique<BitImage>();
  const auto scratch = std::make_unique<BitImage>();
  image->reset(80, 40);
  for (int v = 10; v < 25; ++v) {
    for (int u = 55; u < 70; ++u) image->set(u, v);  // a square over a word's border
  }
  image->clear(64, 17);
  for (int u = 40; u < 55; ++u) image->set(u, 15);  // a burr one pixel thick
  image->set(5, 5);
  open_and_close(*image, *scratch);
  int set = 0;
  for (int v = 0; v < 40; ++v) {
    for (int u = 0; u < 80; ++u) set += image->at(u, v) ? 1 : 0;
  }
  EXPECT_EQ(set, 15 * 15);
  EXPECT_TRUE(image->at(64, 17));
}

}  // namespace
}  // namespace pharos::tof
