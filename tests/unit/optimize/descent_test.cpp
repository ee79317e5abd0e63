// SPDX-License-Identifier: Apache-2.0
#include "pharos/optimize/descent.hpp"

#include <gtest/gtest.h>

#include "problems.hpp"

namespace pharos::optimize {
namespace {

constexpr double kTolerance = 1e-20;
const VectorOf<3> kStart(-1.2, 1.0, 1.0);
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Descent, SolvesAQuadraticInOneStep) {
  std::mt19937_64 random(1);
  const Linear<6> problem(random);
  Descent<Linear<6>> d;
  int taken = 0;
  descend(
      problem, VectorOf<6>::Constant(5.0), {.tolerance = kTolerance}, [&](const auto&, double) { return ++taken > 1; },
      d);
  EXPECT_TRUE(d.converged());
  EXPECT_EQ(taken, 1);
  EXPECT_EQ(d.iterations, 2);  // the second step gives no improvement
  const VectorOf<6> gradient = problem.A.transpose() * (problem.A * d.state - problem.b);
  EXPECT_LT(gradient.norm(), 1e-12);
}

TEST(Descent, TakesAStepBelowTheToleranceWithoutLinearisingAgain) {
  std::mt19937_64 random(2);
  const Linear<3> problem(random);
  Descent<Linear<3>> d;
  descend(problem, VectorOf<3>::Zero(), {.tolerance = 1e6}, d);
  EXPECT_TRUE(d.converged());
  EXPECT_EQ(d.iterations, 1);
  EXPECT_NEAR(d.normal.cost, problem.linearise(d.state).cost, 1e-12);  // as predicted by the linear model
}

TEST(Descent, FollowsRosenbrocksValley) {
  for (const VectorOf<3>& start : {kStart, VectorOf<3>(-30.0, 40.0, 2.0), VectorOf<3>(0.0, -5.0, 9.0)}) {
    Descent<Rosenbrock> d;
    descend(Rosenbrock(), start, {.tolerance = kTolerance}, d);
    EXPECT_TRUE(d.converged());
    EXPECT_LT((d.state - VectorOf<3>::Ones()).norm(), 1e-9);
  }
}

TEST(Descent, FindsTheMinimumOfThirteenUnknowns) {
  std::mt19937_64 random(3);
  const Linear<13> problem(random);
  Descent<Linear<13>> d;
  descend(problem, VectorOf<13>::Zero(), {.tolerance = kTolerance}, d);
  EXPECT_TRUE(d.converged());
  EXPECT_LT((problem.A.transpose() * (problem.A * d.state - problem.b)).norm(), 1e-11);
}

TEST(Descent, LowersTheCostWithEveryStepAndStaysFinite) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int converged = 0;
  constexpr int kProblems = 60;
  for (int k = 0; k < kProblems; ++k) {
    const double amplitude = 1.0 + 4.0 * uniform(random), rate = 0.3 + 2.0 * uniform(random);
    const Decay problem({amplitude, rate, uniform(random)}, 1e-3, random);
    const VectorOf<3> start(10.0 * uniform(random), 4.0 * uniform(random) - 1.0, 0.0);
    double cost = problem.linearise(start).cost;
    const double at_start = cost;
    Descent<Decay> d;
    descend(
        problem, start, {.tolerance = 1e-12},
        [&](const VectorOf<3>& state, double now) {
          EXPECT_LE(now, cost);
          EXPECT_TRUE(state.allFinite());
          EXPECT_EQ(now, problem.linearise(state).cost);
          cost = now;
          return false;
        },
        d);
    EXPECT_TRUE(d.state.allFinite());
    EXPECT_LE(problem.linearise(d.state).cost, at_start);
    if (!d.converged() || problem.linearise(d.state).cost > 1e-4) continue;  // flat valleys may end elsewhere
    ++converged;
    EXPECT_LT((d.state - problem.truth).norm(), 0.05);
  }
  EXPECT_GT(converged, kProblems * 3 / 4);
}

TEST(Descent, DoesNotDependOnTheUnitsOfItsUnknowns) {
  std::mt19937_64 random(5);
  const Decay problem({2.0, 0.7, 0.3}, 1e-2, random);
  Decay rescaled = problem;
  rescaled.unit = 1024.0;
  Descent<Decay> one, other;
  descend(problem, {9.0, 3.0, -2.0}, {.tolerance = 1e-12}, one);
  descend(rescaled, {9.0, 3.0 / 1024.0, -2.0}, {.tolerance = 1e-12}, other);
  EXPECT_TRUE(one.converged());
  EXPECT_EQ(one.iterations, other.iterations);
  EXPECT_NEAR(other.state[1] * 1024.0, one.state[1], 1e-12);
  EXPECT_NEAR(other.state[0], one.state[0], 1e-12);
}

TEST(Descent, NeverAcceptsACostThatIsNotANumber) {
  Descent<Logarithm> d;
  bool all_finite = true;
  descend(
      Logarithm(), VectorOf<1>(20.0), {.tolerance = kTolerance},
      [&](const VectorOf<1>& state, double cost) {
        all_finite = all_finite && std::isfinite(cost) && state[0] > 0.0;
        return false;
      },
      d);
  EXPECT_TRUE(all_finite);
  EXPECT_TRUE(d.converged());
  EXPECT_NEAR(d.state[0], 2.0, 1e-9);
}

// Every trial step is refused, because all states near the start are `beside`.
struct Needle : VectorProblem<1> {
  double beside = kNan;
  NormalEquations<1> linearise(const VectorOf<1>& x) const {
    NormalEquations<1> normal;
    normal.add(VectorOf<1>(1.0), 1.0);
    if (x[0] != 0.0) normal.cost = beside;
    return normal;
  }
};

TEST(Descent, ReturnsTheStartWhereNothingBesideItIsANumberOrLower) {
  for (const double beside : {kNan, std::numeric_limits<double>::infinity(), 2.0}) {
    Needle problem;
    problem.beside = beside;
    Descent<Needle> d;
    descend(problem, VectorOf<1>(0.0), {.tolerance = 1e-30}, d);
    EXPECT_EQ(d.ending, Ending::kMaxDamping);
    EXPECT_FALSE(d.decided());
    EXPECT_EQ(d.state[0], 0.0);
    EXPECT_EQ(d.normal.cost, 1.0);
  }
}

TEST(Descent, StallsAtOnceWhereOnlyDampedStepsAreBelowTheTolerance) {
  Needle problem;
  Descent<Needle> d;
  descend(problem, VectorOf<1>(0.0), {.tolerance = 1e-3}, d);
  EXPECT_EQ(d.ending, Ending::kStalled);
  EXPECT_LT(d.iterations, 20);
  EXPECT_EQ(d.state[0], 0.0);
}

// Steps are infinite.
struct Infinite : VectorProblem<3> {
  NormalEquations<3> linearise(const VectorOf<3>& x) const {
    NormalEquations<3> normal;
    for (int i = 0; i < 3; ++i) normal.add(1e-150 * VectorOf<3>::Unit(i), 1e160);
    normal.cost = 1.0 + x.squaredNorm();
    return normal;
  }
};

TEST(Descent, ReturnsNothingThatIsNotFinite) {
  Descent<Infinite> d;
  descend(Infinite(), {1.0, 2.0, 3.0}, {.tolerance = 1.0}, d);
  EXPECT_FALSE(d.converged());
  EXPECT_EQ(d.state, (VectorOf<3>(1.0, 2.0, 3.0)));
}

TEST(Descent, BeginsNowhereWhereTheStartIsNotANumber) {
  for (const double start : {-1.0, 0.0, kNan}) {
    Descent<Logarithm> d;
    descend(Logarithm(), VectorOf<1>(start), {}, d);
    EXPECT_EQ(d.ending, Ending::kBadStart);
    EXPECT_FALSE(d.converged());
    EXPECT_EQ(d.iterations, 0);
  }
}

TEST(Descent, HoldsWhatARankDeficientProblemDoesNotTell) {
  Descent<SumOnly<false>> d;
  descend(SumOnly<false>(), {1.0, 0.5, 7.0}, {.tolerance = 1e-16}, d);
  EXPECT_EQ(d.ending, Ending::kStalled);
  EXPECT_NEAR(d.state[0] + d.state[1], 3.0, 1e-6);
  EXPECT_NEAR(d.state[0] - d.state[1], 0.5, 1e-3);
  EXPECT_EQ(d.state[2], 7.0);
}

TEST(Descent, EndsAtARankDeficientProblemWhereThatIsAskedFor) {
  Descent<SumOnly<true>> d;
  descend(SumOnly<true>(), {1.0, 0.5, 7.0}, {.tolerance = 1e-16}, d);
  EXPECT_EQ(d.ending, Ending::kSingular);
  EXPECT_EQ(d.iterations, 1);
  EXPECT_EQ(d.state, (VectorOf<3>(1.0, 0.5, 7.0)));
}

TEST(Descent, EndsAtTheMostIterations) {
  for (const int maximum : {0, 1, 3}) {
    Descent<Rosenbrock> d;
    descend(Rosenbrock(), kStart, {.max_iterations = maximum, .tolerance = kTolerance}, d);
    EXPECT_EQ(d.ending, Ending::kMaxIterations);
    EXPECT_EQ(d.iterations, maximum);
    EXPECT_LE(d.normal.cost, Rosenbrock().linearise(kStart).cost);
  }
}

TEST(Descent, GivesUpWhereTheCostStaysHopeless) {
  std::mt19937_64 random(6);
  const Linear<3> problem(random);
  Descent<Linear<3>> d;
  const double minimum = [&] {
    descend(problem, VectorOf<3>::Zero(), {.tolerance = kTolerance}, d);
    return d.normal.cost;
  }();
  ASSERT_GT(minimum, 0.1);
  descend(problem, VectorOf<3>::Constant(9.0), {.tolerance = 0.0, .hopeless_cost = 0.5 * minimum}, d);
  EXPECT_EQ(d.ending, Ending::kHopeless);
  EXPECT_TRUE(d.decided());
  EXPECT_FALSE(d.converged());
  descend(problem, VectorOf<3>::Constant(9.0), {.tolerance = kTolerance, .hopeless_cost = 2.0 * minimum}, d);
  EXPECT_TRUE(d.converged());
}

TEST(Descent, StopsWhereItIsAskedTo) {
  Descent<Rosenbrock> d;
  descend(
      Rosenbrock(), kStart, {.tolerance = kTolerance}, [](const VectorOf<3>& x, double) { return x[0] > 0.0; }, d);
  EXPECT_EQ(d.ending, Ending::kStopped);
  EXPECT_GT(d.state[0], 0.0);
  EXPECT_LT(d.state[0], 1.0);
}

struct SumsAtEnd : Decay {
  using Decay::Decay;
  static constexpr bool kSumsAtEnd = true;
};

TEST(Descent, EndsWithTheInformationOfItsStateWhereThatIsAskedFor) {
  std::mt19937_64 random(7);
  const SumsAtEnd problem({2.0, 0.7, 0.3}, 1e-2, random);
  Descent<SumsAtEnd> d;
  descend(problem, {1.5, 0.9, 0.0}, {.tolerance = 1e-4}, d);
  ASSERT_TRUE(d.converged());
  const NormalEquations<3> there = problem.linearise(d.state);
  EXPECT_EQ(d.normal.cost, there.cost);
  EXPECT_EQ(d.normal.matrix, there.matrix);
}

struct DampedFirst : Rosenbrock {
  static constexpr double kFirstDamping = 1e6;
};

TEST(Descent, BeginsWithTheDampingThatTheProblemAsksFor) {
  Descent<DampedFirst> d;
  descend(DampedFirst(), kStart, {.max_iterations = 1, .tolerance = 0.0}, d);
  EXPECT_LT((d.state - kStart).norm(), 1e-4);
  descend(DampedFirst(), kStart, {.max_iterations = 200, .tolerance = 1e-12}, d);
  EXPECT_TRUE(d.converged());
  EXPECT_LT((d.state - VectorOf<3>::Ones()).norm(), 1e-5);
}

}  // namespace
}  // namespace pharos::optimize
