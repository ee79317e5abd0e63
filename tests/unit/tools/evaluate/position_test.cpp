// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pharos/geometry/rotation.hpp"
#include "tools/evaluate/position_comparison.hpp"

namespace pharos::evaluate {
namespace {

const Matrix3 kWorld = rotation_exp({0.3, -0.8, 1.2});
const Vector3 kShift(1.0, -2.0, 0.5);
const Vector3 kLever(0.02, -0.01, 0.03);
constexpr double kRate = 1.0107, kOffset_s = 400.0;

Vector3 path(double t) {
  return {std::sin(0.7 * t) + 0.2 * std::sin(3.1 * t), std::cos(0.5 * t), 0.5 * std::sin(1.3 * t)};
}
Matrix3 attitude(double t) {
  return rotation_exp({0.6 * std::sin(0.9 * t), 0.5 * std::cos(0.4 * t), 0.8 * std::sin(0.3 * t)});
}

struct Pair {
  PositionTrack estimate, truth;
};

// A body of known path, its marker `kLever` off, in another frame and on another clock; noise of 3 mm a component.
Pair simulated(double noise_m) {
  Pair pair;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, noise_m);
  for (double t = 10.0; t < 70.0; t += 0.02) {
    PositionSample s;
    s.time_s = t;
    s.R_world_body = attitude(t);
    s.position_m = path(t) + Vector3(noise(random), noise(random), noise(random));
    s.covariance_m2 = Matrix3(9e-6 * Matrix3::Identity());
    pair.estimate.samples.push_back(s);
  }
  for (double t = 12.0; t < 65.0; t += 0.004) {
    const Vector3 marker = path(t) + attitude(t) * kLever;
    pair.truth.samples.push_back({kOffset_s + kRate * t, kWorld.transpose() * (marker - kShift), {}, {}, {}});
  }
  return pair;
}

TEST(PositionComparison, FindsFramesClocksAndLeverArm) {
  const Pair pair = simulated(0.003);
  PositionOptions options;
  options.estimate_lever_arm = true;
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, options);
  ASSERT_TRUE(c.refused.empty()) << c.why;
  EXPECT_NEAR(c.rate, kRate, 1e-4);
  EXPECT_NEAR(rotation_angle_between(c.R_estimate_truth, kWorld), 0.0, 0.005);
  EXPECT_NEAR((c.lever_m - kLever).norm(), 0.0, 0.001);
  EXPECT_NEAR(c.rms_m, 0.003 * std::sqrt(3.0), 0.0003);
  ASSERT_TRUE(c.nees_per_dof);
  EXPECT_NEAR(*c.nees_per_dof, 1.0, 0.1);
  EXPECT_LE(c.median_m, c.p95_m);
  EXPECT_LE(c.p95_m, c.max_m);
}

// An attitude 0.1 rad off an axis moves the marker by up to 4 mm: NEES was 2 with the position's 3 mm alone.
TEST(PositionComparison, AnUnsureAttitudeMakesAMarkerAtALeverArmUnsure) {
  constexpr double kTurn_rad = 0.1;
  Pair pair = simulated(0.003);
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0.0, kTurn_rad);
  for (PositionSample& s : pair.estimate.samples) {
    s.R_world_body = rotation_exp({noise(random), noise(random), noise(random)}) * *s.R_world_body;
    s.attitude_covariance_rad2 = Matrix3(kTurn_rad * kTurn_rad * Matrix3::Identity());
  }
  PositionOptions options;
  options.estimate_lever_arm = true;
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, options);
  ASSERT_TRUE(c.refused.empty()) << c.why;
  ASSERT_TRUE(c.nees_per_dof);
  EXPECT_NEAR(*c.nees_per_dof, 1.0, 0.1);
  EXPECT_LT(c.beyond_5_sigmas, c.judged / 500);
}

TEST(PositionComparison, MarksThatAreFiftyMillisecondsOffLeadToTheSame) {
  const Pair pair = simulated(0.0);
  PositionOptions options;
  options.estimate_lever_arm = true;
  options.marks_s = std::pair(12.0 + 0.05, 65.0 - 0.03);
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, options);
  ASSERT_TRUE(c.refused.empty()) << c.why;
  EXPECT_LT(c.max_m, 0.003);
  options.window_s = 0.0;
  EXPECT_GT(compare_positions(pair.estimate, pair.truth, options).mean_m, 0.01);
}

TEST(PositionComparison, CountsEpochsThatHaveNoAnswer) {
  Pair pair = simulated(0.001);
  std::erase_if(pair.estimate.samples, [](const PositionSample& s) { return s.time_s > 30.0 && s.time_s < 40.0; });
  PositionOptions options;
  options.marks_s = std::pair(12.0, 65.0);
  options.epochs_s.emplace();
  for (double t = 20.05; t < 60.0; t += 0.1) options.epochs_s->push_back(t);
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, options);
  EXPECT_NEAR(static_cast<double>(c.epochs), 400.0, 1.0);
  EXPECT_NEAR(static_cast<double>(c.epochs_answered), 300.0, 2.0);
  EXPECT_LE(c.compared, 300U);
}

TEST(PositionComparison, OfABodyAtRestOnlyTheSpreadCounts) {
  Pair pair;
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0.0, 0.001);
  for (int i = 0; i < 1000; ++i) {
    pair.estimate.samples.push_back(
        {5.0 + 0.01 * i, Vector3(1 + noise(random), noise(random), noise(random)), {}, {}, {}});
    pair.truth.samples.push_back({100.0 + 0.01 * i, Vector3(4, 5, 6), {}, {}, {}});
  }
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, {});
  ASSERT_TRUE(c.refused.empty()) << c.why;
  EXPECT_TRUE(c.stationary);
  EXPECT_NEAR(c.spread_m, 0.001 * std::sqrt(3.0), 1e-4);
}

TEST(PositionComparison, RefusesWhatDoesNotMoveAlike) {
  Pair pair = simulated(0.0);
  std::mt19937 random(7);
  std::normal_distribution<double> step(0.0, 0.02);
  Vector3 at = Vector3::Zero();
  for (PositionSample& s : pair.truth.samples) {
    at += Vector3(step(random), step(random), step(random));
    s.position_m = at;
  }
  const PositionComparison c = compare_positions(pair.estimate, pair.truth, {});
  EXPECT_EQ(c.refused, "refused_time_offset");
}

}  // namespace
}  // namespace pharos::evaluate
