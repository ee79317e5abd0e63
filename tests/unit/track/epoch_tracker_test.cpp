// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/epoch_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pharos/base/ticks.hpp"
#include "support/ideal_sweep.hpp"

namespace pharos::track {
namespace {

using lighthouse::Sweep;
using test::cube_target;
using test::kHalfTurn;
using test::kTurn;
using test::make_sweep;
using test::some_calibration;
using test::some_pose;

// Hits are stamped to half a tick: 3.8 urad. The resulting errors of a pose of this target at 2 m.
constexpr double kPoseTolerance_m = 1e-3;
constexpr double kPoseTolerance_rad = 2e-3;

void expect_pose(const EpochResult& result, const LighthouseFromBody& truth) {
  ASSERT_TRUE(result.pose.ok());
  const Vector6 error = pose_difference(result.pose->pose, truth);
  EXPECT_LT(error.head<3>().norm(), kPoseTolerance_rad);
  EXPECT_LT(error.tail<3>().norm(), kPoseTolerance_m);
}

TEST(EpochTracker, AnswersACycleWithItsPoseAtTheMeanHitTime) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  tracker.set_calibration(0, some_calibration());
  EXPECT_FALSE(tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kX, 1'000'000)));
  const auto result =
      tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kY, 1'000'000 + kHalfTurn));
  ASSERT_TRUE(result);
  expect_pose(*result, some_pose());
  EXPECT_EQ(result->observations, 16);
  EXPECT_EQ(result->flags & kEpochUncalibrated, 0);
  EXPECT_EQ(result->flags & kEpochOutliers, 0);
  // Hits lie about a quarter turn after their flashes; the mean of both sweeps half a turn apart.
  EXPECT_NEAR(static_cast<double>(result->time_ticks), 1'000'000 + kTurn / 4 + kTurn / 4, kTurn * 0.05);
  EXPECT_EQ(result->pose->time_ns, result->time_ticks * kNanosecondsPerTick);
  ASSERT_EQ(tracker.bearing_count(), 16u);
  for (std::size_t i = 0; i < tracker.bearing_count(); ++i) {
    EXPECT_TRUE(tracker.bearing(i).used);
    // Half a tick and the error of the fit: below 2 ticks (15 urad); the station's phases alone are 16 and 38 mrad.
    EXPECT_LT(std::abs(tracker.bearing(i).residual_rad), 15e-6);
    EXPECT_GT(std::abs(tracker.bearing(i).ideal_theta_rad - tracker.bearing(i).raw.theta_rad), 5e-3);
  }
}

TEST(EpochTracker, KnowsNothingOfASlotWhoseCalibrationWasCleared) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  tracker.set_calibration(0, some_calibration());
  tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kX, 0));
  tracker.clear_calibration(0);
  EXPECT_FALSE(tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kX, 2 * kHalfTurn)));
  tracker.clear_calibration(0);  // changes nothing any more
  const auto result = tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kY, 3 * kHalfTurn));
  ASSERT_TRUE(result);
  EXPECT_NE(result->flags & kEpochUncalibrated, 0);
  EXPECT_EQ(result->observations, 16);
}

TEST(EpochTracker, SaysWhenNoCalibrationIsKnownAndThenMeasuresWrong) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kX, 0));
  const auto result = tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kY, kHalfTurn));
  ASSERT_TRUE(result);
  EXPECT_NE(result->flags & kEpochUncalibrated, 0);
  ASSERT_TRUE(result->pose.ok());
  // Phases of 16 and 38 mrad at 2 m: 30 to 80 mm.
  EXPECT_GT((result->pose->pose.t - some_pose().t).norm(), 0.02);
}

TEST(EpochTracker, LeavesAReflectionOutAndSaysSo) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  tracker.set_calibration(0, some_calibration());
  Sweep x = make_sweep(target, some_pose(), some_calibration(), Axis::kX, 0);
  lighthouse::Hit reflection = x.hits[2];
  reflection.centre_half_ticks += 2 * 866;
  x.hits.push_back(reflection);
  tracker.push(x);
  const auto result = tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kY, kHalfTurn));
  ASSERT_TRUE(result);
  expect_pose(*result, some_pose());
  EXPECT_EQ(result->observations, 16);
  EXPECT_NE(result->flags & kEpochOutliers, 0);
}

TEST(EpochTracker, UsesSensorsThatWereHitOnOneAxisOnly) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  tracker.set_calibration(0, some_calibration());
  Sweep x = make_sweep(target, some_pose(), some_calibration(), Axis::kX, 0);
  x.hits.erase_unordered(0);
  x.hits.erase_unordered(3);
  tracker.push(x);
  const auto result = tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kY, kHalfTurn));
  ASSERT_TRUE(result);
  expect_pose(*result, some_pose());
  EXPECT_EQ(result->observations, 14);
}

TEST(EpochTracker, ThreeSensorsNeedAFreshPoseBeforeThem) {
  const Target target = cube_target();
  Target three;
  for (std::size_t i : {0u, 3u, 5u}) three.push_back(target[i]);
  TrackOptions options;
  EpochTracker tracker(target, options);
  tracker.set_calibration(0, some_calibration());
  const auto cycle_of = [&](const Target& lit, std::int64_t start) {
    tracker.push(make_sweep(lit, some_pose(), some_calibration(), Axis::kX, start));
    return tracker.push(make_sweep(lit, some_pose(), some_calibration(), Axis::kY, start + kHalfTurn));
  };
  const auto without = cycle_of(three, 0);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->pose.error(), pose::Refusal::kTooFewSensors);
  cycle_of(target, 2 * kHalfTurn);
  const auto with = cycle_of(three, 4 * kHalfTurn);
  ASSERT_TRUE(with);
  expect_pose(*with, some_pose());
  EXPECT_NE(with->flags & kEpochPrior, 0);
  // A pose from three sensors needs a prior from a complete solution, not from another such pose.
  bool refused = false;
  for (std::int64_t cycle = 6; cycle < 20; cycle += 2) {
    const auto next = cycle_of(three, cycle * kHalfTurn);
    ASSERT_TRUE(next);
    refused = refused || !next->pose.ok();
  }
  EXPECT_TRUE(refused);
  const auto stale = cycle_of(three, 4 * kHalfTurn + 10'000'000);
  ASSERT_TRUE(stale);
  EXPECT_FALSE(stale->pose.ok());
}

TEST(EpochTracker, KeepsTwoStationsApart) {
  const Target target = cube_target();
  EpochTracker tracker(target, {});
  const LighthouseFromBody other{rotation_exp({-0.2, 0.5, 1.3}), {-0.4, 0.1, 3.0}};
  tracker.set_calibration(0, some_calibration());
  tracker.set_calibration(1, {});
  tracker.push(make_sweep(target, some_pose(), some_calibration(), Axis::kX, 0));
  EXPECT_FALSE(tracker.push(make_sweep(target, other, {}, Axis::kX, 2 * kHalfTurn, 1)));
  const auto second = tracker.push(make_sweep(target, other, {}, Axis::kY, 3 * kHalfTurn, 1));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->station, 1);
  expect_pose(*second, other);
  const auto rest = tracker.flush();
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->station, 0);
  EXPECT_FALSE(rest->pose.ok());
  EXPECT_FALSE(tracker.flush());
}

TEST(EpochTracker, WarmStartChangesNoAnswer) {
  const Target target = cube_target();
  TrackOptions warm_options;
  warm_options.warm_start = true;
  EpochTracker cold(target, {});
  EpochTracker warm(target, warm_options);
  for (EpochTracker* tracker : {&cold, &warm}) tracker->set_calibration(0, some_calibration());
  for (int i = 0; i < 50; ++i) {
    Vector6 moved;
    moved << 0.01 * i, 0, 0.02 * i, 0.002 * i, 0, -0.003 * i;
    const LighthouseFromBody truth = some_pose().moved_by(moved);
    const std::int64_t start = 2 * i * kHalfTurn;
    for (EpochTracker* tracker : {&cold, &warm}) {
      tracker->push(make_sweep(target, truth, some_calibration(), Axis::kX, start));
      const auto result = tracker->push(make_sweep(target, truth, some_calibration(), Axis::kY, start + kHalfTurn));
      ASSERT_TRUE(result);
      expect_pose(*result, truth);
    }
  }
}

TEST(EpochTracker, WarmStartUsesSensorsThatWereHitOnOneAxisOnly) {
  const Target target = cube_target();
  TrackOptions options;
  options.warm_start = true;
  options.solve.max_search_starts = 0;  // integer arithmetic only
  EpochTracker tracker(target, options);
  tracker.set_calibration(0, some_calibration());
  for (int i = 0; i < 50; ++i) {
    Vector6 moved;
    moved << 0.01 * i, 0, 0.02 * i, 0.002 * i, 0, -0.003 * i;
    const LighthouseFromBody truth = some_pose().moved_by(moved);
    const std::int64_t start = 2 * i * kHalfTurn;
    Sweep x = make_sweep(target, truth, some_calibration(), Axis::kX, start);
    if (i > 0) {
      x.hits.erase_unordered(0);
      x.hits.erase_unordered(3);
    }
    tracker.push(x);
    const auto result = tracker.push(make_sweep(target, truth, some_calibration(), Axis::kY, start + kHalfTurn));
    ASSERT_TRUE(result);
    expect_pose(*result, truth);
    EXPECT_EQ(result->observations, i > 0 ? 14 : 16);
  }
}

class SearchLimit : public ::testing::Test {
 protected:
  SearchLimit() { tracker_.set_calibration(0, some_calibration()); }
  static TrackOptions options() {
    TrackOptions options;
    options.warm_start = true;
    options.solve.max_search_starts = 2;
    options.search_cooldown_ticks = kTicksPerSecond;
    return options;
  }
  // The result of the cycle that begins so many turns after the start; `torn`: hits that fit no rigid body.
  pose::Refusal refusal(std::int64_t turns, bool torn, bool with_y = true) {
    Sweep x = make_sweep(target_, some_pose(), some_calibration(), Axis::kX, 2 * turns * kHalfTurn);
    Sweep y = make_sweep(target_, some_pose(), some_calibration(), Axis::kY, (2 * turns + 1) * kHalfTurn);
    std::int32_t i = 0;
    for (lighthouse::Hit& hit : x.hits) {
      if (torn) hit.centre_half_ticks += 4000 * (i * i % 7);
      ++i;
    }
    auto result = tracker_.push(x);
    if (with_y) result = tracker_.push(y);
    return !result || result->pose.ok() ? pose::Refusal::kNone : result->pose.error();
  }

  const Target target_ = cube_target();
  EpochTracker tracker_{target_, options()};
};

TEST_F(SearchLimit, EndsASearchAndWaitsForTheCooldown) {
  EXPECT_EQ(refusal(0, true), pose::Refusal::kSearchLimit);
  EXPECT_EQ(refusal(1, false), pose::Refusal::kSearchLimit);  // solvable, but only by a search
  EXPECT_EQ(refusal(59, false), pose::Refusal::kSearchLimit);
  EXPECT_EQ(refusal(61, false), pose::Refusal::kNone);
}

TEST_F(SearchLimit, SolvesFromTheLastPoseDuringTheCooldown) {
  EXPECT_EQ(refusal(0, false), pose::Refusal::kNone);
  EXPECT_EQ(refusal(1, true), pose::Refusal::kSearchLimit);
  EXPECT_EQ(refusal(2, false), pose::Refusal::kNone);
}

TEST_F(SearchLimit, RefusesOneAxisAloneWithoutACooldown) {
  EXPECT_EQ(refusal(0, false, false), pose::Refusal::kNone);  // not complete yet
  EXPECT_EQ(refusal(4, false, false), pose::Refusal::kDegenerate);
  EXPECT_EQ(refusal(8, false), pose::Refusal::kNone);
}

}  // namespace
}  // namespace pharos::track
