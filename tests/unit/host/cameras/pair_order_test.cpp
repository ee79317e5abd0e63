// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/pair_order.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pharos::host {
namespace {

TEST(PairOrder, TheSamePixelsAreNoPair) {
  std::vector<std::uint16_t> one(12, 7), other = one;
  const ImageView<const std::uint16_t> left(one.data(), 4, 3), right(other.data(), 4, 3);
  EXPECT_EQ(pair_fault({left, right}), PairFault::kEqual);
  other.back() = 8;
  EXPECT_EQ(pair_fault({left, right}), PairFault::kNone);
  EXPECT_EQ(pair_fault({left, ImageView<const std::uint16_t>(other.data(), 3, 4)}), PairFault::kNone);
}

TEST(PairOrder, ARightCameraOnTheLeftIsExchanged) {
  EXPECT_EQ(pair_fault({-0.9, 0.1, 0.2}), PairFault::kExchanged);
  EXPECT_EQ(pair_fault({0.9, 0.1, 0.2}), PairFault::kNone);
  EXPECT_EQ(pair_fault({-0.1, 0.9, 0.0}), PairFault::kNone);
}

TEST(PairOrder, OneWordingForAllCommands) {
  EXPECT_EQ(text_of(PairFault::kExchanged),
            "left and right images seem to be exchanged: what both show lies on the wrong side");
  EXPECT_NE(text_of(PairFault::kEqual).find("same picture"), std::string::npos);
  EXPECT_EQ(text_of(PairFault::kNone), "");
}

}  // namespace
}  // namespace pharos::host
