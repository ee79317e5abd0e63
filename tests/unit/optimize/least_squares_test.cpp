// SPDX-License-Identifier: Apache-2.0
#include "pharos/optimize/least_squares.hpp"

#include <gtest/gtest.h>

#include "problems.hpp"

namespace pharos::optimize {
namespace {

TEST(DampedStep, SolvesTheNormalEquations) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20; ++k) {
    const Linear<7> problem(random);
    const NormalEquations<7> normal = problem.linearise(VectorOf<7>::Constant(0.5));
    for (const double damping : {0.0, 1e-3, 1.0, 1e6}) {
      const DampedStep<7> step = damped_step<7>(normal, damping);
      VectorOf<7> left = normal.matrix * step.delta + normal.gradient;
      for (int i = 0; i < 7; ++i) left[i] += damping * normal.matrix(i, i) * step.delta[i];
      EXPECT_TRUE(step.solved);
      EXPECT_LT(left.norm(), 1e-11 * normal.gradient.norm());
      EXPECT_NEAR(step.decrease, -normal.gradient.dot(step.delta), 1e-12);
      EXPECT_GT(step.decrease, 0.0);
    }
  }
}

TEST(DampedStep, PredictsTheDecreaseOfAQuadratic) {
  std::mt19937_64 random(2);
  const Linear<4> problem(random);
  const NormalEquations<4> normal = problem.linearise(VectorOf<4>::Zero());
  const DampedStep<4> step = damped_step<4>(normal, 0.0);
  EXPECT_NEAR(problem.linearise(step.delta).cost, normal.cost - step.decrease, 1e-12);
}

TEST(DampedStep, IsNotSolvedWhereUnknownsAreNotTold) {
  const NormalEquations<3> normal = SumOnly<false>().linearise({1.0, 0.5, 7.0});
  const DampedStep<3> undamped = damped_step<3>(normal, 0.0);
  EXPECT_FALSE(undamped.solved);
  EXPECT_LE(undamped.smallest_pivot_ratio, 1e-14);
  const DampedStep<3> damped = damped_step<3>(normal, 1e-3);
  EXPECT_TRUE(damped.solved);
  EXPECT_EQ(damped.delta[2], 0.0);
  EXPECT_NEAR(damped.delta[0], damped.delta[1], 1e-12);
}

TEST(DampedStep, IsNotSolvedWhereNothingIsTold) {
  const DampedStep<3> step = damped_step<3>(NormalEquations<3>{}, 1.0);
  EXPECT_FALSE(step.solved);
  EXPECT_TRUE(step.delta.allFinite());
}

TEST(NormalEquations, AreThoseOfWeightedRows) {
  NormalEquations<2> normal;
  normal.add({1.0, 2.0}, 3.0, 0.5);
  normal.add({-1.0, 4.0}, 1.0);
  EXPECT_EQ(normal.matrix(0, 0), 1.5);
  EXPECT_EQ(normal.matrix(0, 1), -3.0);
  EXPECT_EQ(normal.matrix(1, 0), -3.0);
  EXPECT_EQ(normal.matrix(1, 1), 18.0);
  EXPECT_EQ(normal.gradient[0], 0.5);
  EXPECT_EQ(normal.gradient[1], 7.0);
  EXPECT_EQ(normal.cost, 5.5);
}

}  // namespace
}  // namespace pharos::optimize
