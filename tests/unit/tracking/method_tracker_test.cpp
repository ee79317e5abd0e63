// SPDX-License-Identifier: Apache-2.0
#include "pharos/tracking/method_tracker.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "pharos/tracking/calibrated_tracker.hpp"
#include "support/ideal_sweep.hpp"

namespace pharos::tracking {
namespace {

using test::cube_target;
using test::kHalfTurn;
using test::make_sweep;
using test::some_calibration;
using test::some_pose;
using Tested = CalibratedTracker<MethodTracker>;

/// A survey of both slots and of the second station's pose, with an error of `wrong_m`.
class Surveyed {
 public:
  explicit Surveyed(double wrong_m = 0.0) {
    pair_.reference = 1;
    pair_.station = 2;
    pair_.T_reference_station = T_0_1();
    pair_.T_reference_station.t[0] += wrong_m;
    pair_.covariance.diagonal().setConstant(1e-7);
  }
  static motion::StationFromStation T_0_1() { return {rotation_exp({0.0, -0.5, 0.0}), {1.5, 0.1, 0.2}}; }
  static LighthouseFromBody pose_before(std::uint8_t station) {
    return station == 0 ? some_pose() : T_0_1().inverse() * some_pose();
  }
  CalibrationPolicy policy() const {
    CalibrationPolicy policy;
    policy.use_sent = false;
    policy.survey = &survey_;
    return policy;
  }
  /// Both stations are identified by their payloads.
  static void name(Tested& tracker) {
    lighthouse::CalibrationStore sent;
    for (const std::uint8_t station : {std::uint8_t{0}, std::uint8_t{1}}) {
      lighthouse::OotxPayload payload;
      payload.station = station;
      payload.bytes.resize(33);
      for (std::uint8_t& byte : payload.bytes) byte = 0;
      payload.bytes[0] = 6;  // protocol
      payload.bytes[2] = static_cast<std::uint8_t>(station + 1);
      ASSERT_NE(sent.push(payload), lighthouse::CalibrationStore::Verdict::kUnreadable);
    }
    tracker.resume(sent);
  }

 private:
  std::array<KnownStation, kMaxStations> stations_{
      {{{}, std::uint8_t{0}, some_calibration()}, {{}, std::uint8_t{1}, some_calibration()}}};
  CalibratedPair pair_;
  StationSurvey survey_{stations_, &pair_};
};

// Sweep by sweep, the stations alternate: x and y of one, then of the other.
lighthouse::Sweep sweep_number(int number) {
  const auto station = static_cast<std::uint8_t>(number / 2 % 2);
  const Axis axis = number % 2 == 0 ? Axis::kX : Axis::kY;
  return make_sweep(cube_target(), Surveyed::pose_before(station), some_calibration(), axis, number * kHalfTurn,
                    station);
}

template <class Alone>
void expect_same_results(const MethodOptions& options, Alone& alone, int sweeps) {
  const Surveyed surveyed;
  // Not on the stack: two of them are larger than the soft core's.
  const auto tested = std::make_unique<Tested>(surveyed.policy(), cube_target(), options);
  Tested& tracker = *tested;
  for (std::uint8_t station = 0; station < kMaxStations; ++station) alone.set_calibration(station, some_calibration());
  int poses = 0;
  for (int i = 0; i < sweeps; ++i) {
    const auto result = tracker.push(sweep_number(i)), expected = alone.push(sweep_number(i));
    ASSERT_EQ(result.has_value(), expected.has_value());
    if (!result) continue;
    EXPECT_EQ(result->station, expected->station);
    EXPECT_EQ(result->flags, expected->flags);
    EXPECT_EQ(result->time_ticks, expected->time_ticks);
    ASSERT_EQ(result->pose.ok(), expected->pose.ok());
    ASSERT_EQ(tracker.tracker().bearing_count(), alone.bearing_count());
    EXPECT_EQ(tracker.tracker().bearing(0).ideal_theta_rad, alone.bearing(0).ideal_theta_rad);
    if (!result->pose.ok()) continue;
    ++poses;
    EXPECT_TRUE(result->pose->pose.R == expected->pose->pose.R);
    EXPECT_TRUE(result->pose->pose.t == expected->pose->pose.t);
    EXPECT_TRUE(result->pose->covariance == expected->pose->covariance);
  }
  EXPECT_GT(poses, sweeps / 4);
  EXPECT_EQ(tracker.flush().has_value(), alone.flush().has_value());
}

TEST(MethodTracker, EpochAnswersCycleByCycleAsItsTrackerAlone) {
  MethodOptions options;
  options.method = Method::kEpoch;
  track::EpochTracker alone(cube_target(), options.track);
  expect_same_results(options, alone, 12);
}

TEST(MethodTracker, MotionAnswersSweepBySweepAsItsTrackerAlone) {
  MethodOptions options;
  EXPECT_EQ(options.method, Method::kMotion);
  motion::MotionTracker alone(cube_target(), motion::motion_options(options.track, options.systematic, options.limits));
  expect_same_results(options, alone, 20);  // a start takes seven
}

TEST(MethodTracker, EpochHasNoUseForARelativePose) {
  const Surveyed surveyed(0.5);
  MethodOptions options;
  options.method = Method::kEpoch;
  Tested tracker(surveyed.policy(), cube_target(), options);
  Surveyed::name(tracker);
  for (int i = 0; i < 8; ++i) tracker.push(sweep_number(i));
  EXPECT_FALSE(tracker.tracker().relative_pose_rejected());
}

class RelativePose : public ::testing::Test {
 protected:
  static constexpr int kSettled = 400;  // three seconds

  // Number of results from both stations.
  static int fused_after(Tested& tracker, int from) {
    int fused = 0;
    for (int i = from; i < from + kSettled; ++i) {
      const auto result = tracker.push(sweep_number(i));
      if (result && (result->flags & track::kEpochFused) != 0) ++fused;
    }
    return fused;
  }
};

TEST_F(RelativePose, OfThePairAsItStandsIsUsed) {
  const Surveyed surveyed;
  Tested tracker(surveyed.policy(), cube_target(), MethodOptions{});
  Surveyed::name(tracker);
  EXPECT_GT(fused_after(tracker, 0), kSettled / 4);
  EXPECT_FALSE(tracker.tracker().relative_pose_rejected());
}

TEST_F(RelativePose, OfAStationThatWasMovedIsRefusedAndStaysSo) {
  const Surveyed surveyed(0.5);
  Tested tracker(surveyed.policy(), cube_target(), MethodOptions{});
  Surveyed::name(tracker);
  fused_after(tracker, 0);
  EXPECT_TRUE(tracker.tracker().relative_pose_rejected());
  // The stations send their identities again: no change, so the refused survey is not used again.
  Surveyed::name(tracker);
  EXPECT_TRUE(tracker.tracker().relative_pose_rejected());
  EXPECT_GT(fused_after(tracker, kSettled), kSettled / 4) << "how they stand was learnt and is kept";
  tracker.restart_tracking();
  EXPECT_FALSE(tracker.tracker().relative_pose_rejected()) << "all is looked at anew";
}

// Without a calibration an angle is off by tens of milliradians, whatever the method: at this range by a decimetre.
TEST(MethodTracker, WithoutCalibrationTheStatedSigmaIsThatOfRealStations) {
  for (const Method method : {Method::kEpoch, Method::kMotion}) {
    MethodOptions options;
    options.method = method;
    const auto tracker = std::make_unique<Tested>(CalibrationPolicy{}, cube_target(), options);
    int poses = 0;
    for (int i = 0; i < 40; ++i) {
      const Axis axis = i % 2 == 0 ? Axis::kX : Axis::kY;
      const auto result = tracker->push(
          make_sweep(cube_target(), some_pose(), lighthouse::StationCalibration{}, axis, i * kHalfTurn, 0));
      if (!result || !result->pose) continue;
      ++poses;
      EXPECT_GT(result->pose->sigma_position_m(), motion::kFactorySpread.phase_rad * some_pose().t.norm());
      EXPECT_GT(result->pose->sigma_rotation_rad(), motion::kFactorySpread.phase_rad);
    }
    EXPECT_GT(poses, 10);
  }
}

// A station that is not in the file is used with its OOTX parameters, which are less accurate than a calibration.
TEST(MethodTracker, ASentCalibrationLeavesMoreThanTheFileSaysOfItsOwn) {
  MethodOptions options;
  options.systematic = motion::kCalibratedErrors;
  double sigma_m[2] = {};
  for (const auto source : {lighthouse::CalibrationSource::kSurvey, lighthouse::CalibrationSource::kSent}) {
    const auto tracker = std::make_unique<MethodTracker>(cube_target(), options);
    tracker->set_calibration(0, some_calibration(), source);
    for (int i = 0; i < 40; ++i) {
      const Axis axis = i % 2 == 0 ? Axis::kX : Axis::kY;
      const auto result =
          tracker->push(make_sweep(cube_target(), some_pose(), some_calibration(), axis, i * kHalfTurn, 0));
      if (result && result->pose) sigma_m[static_cast<int>(source)] = result->pose->sigma_position_m();
    }
  }
  EXPECT_GT(sigma_m[1], motion::kUncalibratedErrors.rotor_rad * some_pose().t.norm());
  EXPECT_GT(sigma_m[1], 3.0 * sigma_m[0]);
}

}  // namespace
}  // namespace pharos::tracking
