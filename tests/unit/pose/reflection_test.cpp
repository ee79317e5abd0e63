// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/solve.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

// Distances of the recordings' reflections from the true hit: some milliradians to some tens of them.
constexpr double kNearest_rad = 3e-3, kFarthest_rad = 40e-3;

enum class Reflected { kBesideTrueHit, kInsteadOfTrueHit };

struct Corrupted {
  Observations observations;
  std::bitset<kMaxObservations> reflections;
};

// Reflections on both axes of a third of the sensors.
Corrupted corrupt(const test::PnpProblem& problem, Reflected kind, test::PnpGenerator& generator) {
  std::vector<std::uint8_t> sensors;
  for (std::uint8_t s = 0; s < kMaxSensors; ++s) {
    if (problem.seen.test(s)) sensors.push_back(s);
  }
  std::shuffle(sensors.begin(), sensors.end(), generator.engine());
  sensors.resize(sensors.size() / 3);
  Corrupted corrupted{problem.observations, {}};
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    Observation reflection = problem.observations[k];
    if (std::find(sensors.begin(), sensors.end(), reflection.sensor) == sensors.end()) continue;
    const double offset = generator.uniform(kNearest_rad, kFarthest_rad);
    reflection.theta_rad += generator.uniform(0.0, 1.0) < 0.5 ? offset : -offset;
    if (kind == Reflected::kBesideTrueHit) {
      corrupted.reflections.set(corrupted.observations.size());
      corrupted.observations.push_back(reflection);
    } else {
      corrupted.reflections.set(k);
      corrupted.observations[k] = reflection;
    }
  }
  return corrupted;
}

struct Count {
  int wrong_poses = 0, refused = 0, reflections_used = 0, good_hits_lost = 0, good_hits = 0;
};

Count campaign(Reflected kind, int min_sensors, int problems, std::uint64_t seed) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = min_sensors;
  test::PnpGenerator generator(target, set, seed);
  Count count;
  for (int k = 0; k < problems; ++k) {
    const test::PnpProblem problem = generator.next();
    Corrupted corrupted = corrupt(problem, kind, generator);
    const auto solution = solve(target, corrupted.observations, {});
    if (!solution.ok()) {
      ++count.refused;
      continue;
    }
    const LighthousePoseEstimate& e = solution->estimate;
    count.wrong_poses += test::nees_of(problem.truth, e) > 60.0 && !e.ambiguous() ? 1 : 0;
    count.reflections_used += static_cast<int>((solution->used & corrupted.reflections).count());
    for (std::size_t i = 0; i < corrupted.observations.size(); ++i) {
      if (corrupted.reflections.test(i)) continue;
      ++count.good_hits;
      count.good_hits_lost += solution->used.test(i) ? 0 : 1;
    }
  }
  return count;
}

TEST(Reflections, BesideTheTrueHitsOfAThirdOfTheSensorsAreAllDetected) {
  // Set 24 contains a view of six sensors in which nine hits of twelve fit a wrong pose better than the true one.
  for (const std::uint64_t seed : {1U, 24U, 29U}) {
    const Count count = campaign(Reflected::kBesideTrueHit, 6, 300, seed);
    EXPECT_EQ(count.refused, 0);
    EXPECT_EQ(count.wrong_poses, 0);
    EXPECT_EQ(count.reflections_used, 0);
    EXPECT_EQ(count.good_hits_lost, 0);
  }
}

TEST(Reflections, InsteadOfTheTrueHitsOfAThirdOfTheSensorsAreLeftOut) {
  // Two sensors of eight: the other six determine the pose.
  const Count eight = campaign(Reflected::kInsteadOfTrueHit, 8, 300, 2);
  EXPECT_EQ(eight.refused, 0);
  EXPECT_EQ(eight.wrong_poses, 0);
  EXPECT_LE(eight.good_hits_lost, eight.good_hits / 500);
}

// Replaces single hits by reflections; counts wrong poses with a residual that is plausible as noise.
int consistent_outliers(int sensors, int replaced, int problems, std::uint64_t seed) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = set.max_sensors = sensors;
  test::PnpGenerator generator(target, set, seed);
  int lies = 0;
  for (int k = 0; k < problems; ++k) {
    test::PnpProblem problem = generator.next();
    std::vector<std::size_t> hits(problem.observations.size());
    std::iota(hits.begin(), hits.end(), std::size_t{0});
    std::shuffle(hits.begin(), hits.end(), generator.engine());
    for (int i = 0; i < replaced; ++i) {
      const double offset = generator.uniform(kNearest_rad, kFarthest_rad);
      problem.observations[hits[static_cast<std::size_t>(i)]].theta_rad +=
          generator.uniform(0.0, 1.0) < 0.5 ? offset : -offset;
    }
    const auto solution = solve(target, problem.observations, {});
    if (!solution.ok() || solution->estimate.ambiguous()) continue;
    const LighthousePoseEstimate& e = solution->estimate;
    const double chi2 = e.observations * e.residual_rms * e.residual_rms / (kPaperSigma_rad * kPaperSigma_rad);
    lies += test::nees_of(problem.truth, e) > 60.0 && chi2 <= chi2_threshold(e.observations - kPoseUnknowns) ? 1 : 0;
  }
  return lies;
}

TEST(Reflections, InsteadOfTrueHitsGiveNoConsistentWrongPose) {
  // With few sensors a reflection cannot be distinguished from a hit; then the result is a refusal or a residual that
  // shows it.
  constexpr int kProblems = 300;
  for (int sensors = 4; sensors <= 8; ++sensors) {
    for (int replaced = 1; replaced <= sensors / 2; ++replaced) {
      EXPECT_LE(consistent_outliers(sensors, replaced, kProblems, 77), kProblems / 100) << sensors << ", " << replaced;
    }
  }
}

TEST(Reflections, OneHitAtMostIsUsedOfEachSensorAndAxis) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 6;
  test::PnpGenerator generator(target, set, 4);
  for (int k = 0; k < 100; ++k) {
    const Corrupted corrupted = corrupt(generator.next(), Reflected::kBesideTrueHit, generator);
    const auto solution = solve(target, corrupted.observations, {});
    ASSERT_TRUE(solution.ok());
    std::set<std::pair<int, int>> places;
    int used = 0;
    for (std::size_t i = 0; i < corrupted.observations.size(); ++i) {
      if (!solution->used.test(i)) continue;
      ++used;
      const Observation& o = corrupted.observations[i];
      EXPECT_TRUE(places.insert({o.sensor, index_of(o.axis)}).second);
    }
    EXPECT_EQ(used, solution->estimate.observations);
  }
}

TEST(Reflections, HallOfMirrorsIsSolvedWithoutAnExplosion) {
  // Every bearing has four hits: 4^16 combinations.
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 8;
  test::PnpGenerator generator(target, set, 5);
  int right = 0;
  constexpr int kProblems = 50;
  for (int k = 0; k < kProblems; ++k) {
    const test::PnpProblem problem = generator.next();
    Observations observations = problem.observations;
    const LighthouseFromBody prior = problem.truth.moved_by(Vector6::Constant(0.01));
    for (const Observation& o : problem.observations) {
      for (const double offset : {-0.03, 0.02, 0.045}) observations.push_back({o.sensor, o.axis, o.theta_rad + offset});
    }
    const auto solution = solve(target, observations, {}, &prior);
    right += solution.ok() && test::nees_of(problem.truth, solution->estimate) < 60.0 ? 1 : 0;
  }
  EXPECT_GE(right, kProblems * 9 / 10);
}

TEST(Reflections, SystematicErrorsOfAMilliradianAreNoReasonToThrowHitsAway) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.min_sensors = 6;
  set.sigma_rad = 1e-3;  // twenty-three times the solver's assumption
  test::PnpGenerator generator(target, set, 6);
  int lost = 0, hits = 0, refused = 0;
  for (int k = 0; k < 300; ++k) {
    const test::PnpProblem problem = generator.next();
    const auto solution = solve(target, problem.observations, {});
    hits += static_cast<int>(problem.observations.size());
    if (solution.ok()) {
      lost += static_cast<int>(problem.observations.size() - solution->used.count());
    } else {
      ++refused;
    }
  }
  // Noise that by chance looks like reflections on a third of the hits is refused: 1 of these 300.
  EXPECT_LE(refused, 3);
  EXPECT_LE(lost, hits / 100);
}

}  // namespace
}  // namespace pharos::pose
