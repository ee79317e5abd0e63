// SPDX-License-Identifier: Apache-2.0
#include "pharos/optimize/damping.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pharos::optimize {
namespace {

TEST(Damping, IsNoneUntilAStepFails) {
  Damping damping;
  EXPECT_TRUE(damping.none());
  damping.succeeded(1.0);
  EXPECT_TRUE(damping.none());
  EXPECT_TRUE(damping.failed());
  EXPECT_EQ(damping.value(), Damping::kFirst);
}

TEST(Damping, GrowsFasterWithEveryFailure) {
  Damping damping;
  damping.failed();
  double before = damping.value(), growth = 1.0;
  while (damping.failed()) {
    EXPECT_GT(damping.value() / before, growth);
    growth = damping.value() / before;
    before = damping.value();
  }
  EXPECT_GE(damping.value(), Damping::kMax);
}

TEST(Damping, FallsToAThirdWhereTheModelIsRightAndGrowsWhereItIsNot) {
  Damping right(1.0), wrong(1.0);
  right.succeeded(1.0);
  EXPECT_DOUBLE_EQ(right.value(), 1.0 / 3.0);
  wrong.succeeded(0.0);  // the cost did not decrease at all
  EXPECT_DOUBLE_EQ(wrong.value(), 2.0);
}

TEST(Damping, IsNoneAgainWhereItChangesNothing) {
  Damping damping(1e-3);
  int steps = 0;
  for (; !damping.none(); ++steps) damping.succeeded(1.0);
  EXPECT_EQ(steps, 5);  // 1e-3 / 3^5 < 1e-5
}

TEST(Damping, StaysFiniteWhenTheGainIsNotANumber) {
  Damping damping(1.0);
  damping.succeeded(std::numeric_limits<double>::quiet_NaN());
  EXPECT_DOUBLE_EQ(damping.value(), 1.0 / 3.0);
}

}  // namespace
}  // namespace pharos::optimize
