// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_choice.hpp"

#include <gtest/gtest.h>

namespace pharos::pointing {
namespace {

// Along the image's rows.
EdgePair strip(double from_px, double to_px, double middle_px, double width_px) {
  const Vector2 begin(from_px, middle_px), end(to_px, middle_px), half(0.0, 0.5 * width_px);
  return {{begin - half, end - half}, {end + half, begin + half}, {begin, end}, width_px};
}

// Both panels of a wing have too unlike sides to be found; their yokes are in line with a gap as panels are (seed
// 701293 of the campaign, 25 deg off at a stated 1.9).
TEST(Yoke, HoldsALongerAndWiderPairBeyondIt) {
  const EdgePair left = strip(300.0, 380.0, 200.0, 9.0), right = strip(500.0, 580.0, 201.0, 8.0);
  ASSERT_TRUE(is_wing(left, right));
  const EdgePair panel = strip(585.0, 850.0, 206.0, 55.0);
  EXPECT_TRUE(is_yoke(right, left, panel));
  EXPECT_FALSE(is_yoke(left, right, panel)) << "it is beyond the other one";
  EXPECT_TRUE(is_yoke(left, right, strip(40.0, 296.0, 196.0, 55.0)));
}

TEST(Yoke, IsNoPanelBesideItsBodyAndNoPieceOfALongerWing) {
  const EdgePair left = strip(100.0, 380.0, 200.0, 55.0), right = strip(600.0, 880.0, 201.0, 55.0);
  EXPECT_FALSE(is_yoke(left, right, strip(385.0, 595.0, 200.0, 180.0))) << "the body between them";
  EXPECT_FALSE(is_yoke(right, left, strip(900.0, 1190.0, 200.0, 60.0))) << "a third panel as wide";
  EXPECT_FALSE(is_yoke(right, left, strip(900.0, 1000.0, 200.0, 150.0))) << "shorter";
  EXPECT_FALSE(is_yoke(right, left, strip(900.0, 1200.0, 320.0, 150.0))) << "out of line";
}

}  // namespace
}  // namespace pharos::pointing
