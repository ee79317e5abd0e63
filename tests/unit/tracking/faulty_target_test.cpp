// SPDX-License-Identifier: Apache-2.0
// A target whose frames are whole and whose numbers are not: flashes told at wrong times, hits that are shifted. No
// answer that counts as ok is far from the truth by more than it says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "pharos/tracking/calibrated_tracker.hpp"
#include "pharos/tracking/method_tracker.hpp"
#include "tests/unit/motion/flight.hpp"

namespace pharos::tracking {
namespace {

enum class Fault : std::uint8_t { kNone, kWrongTimes, kShiftedSweeps, kShiftedHits, kSteadyOffset };

double log_uniform(sim::RandomStream& random, double low, double high) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

double either_sign(sim::RandomStream& random) { return random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0; }

/// Spoils a fraction of a target's frames.
class FaultyTarget {
 public:
  FaultyTarget(Fault fault, double fraction, std::uint64_t seed)
      : fault_(fault), fraction_(fraction), random_(seed, "faulty target") {
    for (double& offset : steady_) offset = either_sign(random_) * log_uniform(random_, 100.0, 10'000.0);
  }
  void operator()(lighthouse::Sweep& sweep) {
    if (random_.uniform(0.0, 1.0) >= fraction_) return;
    const double sweep_half_ticks = either_sign(random_) * log_uniform(random_, 20.0, 60'000.0);
    switch (fault_) {
      case Fault::kNone:
        return;
      case Fault::kWrongTimes:  // from 1 us to 0.2 s
        sweep.flash.start_ticks += static_cast<std::int64_t>(either_sign(random_) * log_uniform(random_, 50.0, 1e7));
        return;
      case Fault::kShiftedSweeps:
        for (lighthouse::Hit& hit : sweep.hits) shift(hit, sweep_half_ticks);
        return;
      case Fault::kShiftedHits:
        for (lighthouse::Hit& hit : sweep.hits) {
          shift(hit, either_sign(random_) * log_uniform(random_, 20.0, 60'000.0));
        }
        return;
      case Fault::kSteadyOffset:  // the same for a sensor for all time
        for (lighthouse::Hit& hit : sweep.hits) shift(hit, steady_[hit.sensor]);
        return;
    }
  }

 private:
  static void shift(lighthouse::Hit& hit, double half_ticks) {
    const double moved = hit.centre_half_ticks + half_ticks;
    hit.centre_half_ticks = static_cast<std::int32_t>(std::clamp(moved, 1.0, 833'000.0));
  }

  Fault fault_;
  double fraction_;
  sim::RandomStream random_;
  std::array<double, kMaxSensors> steady_{};
};

struct Count {
  int answers = 0, ok = 0, refused = 0, wrong = 0;
  double worst_mm = 0.0, worst_deg = 0.0;
};

bool beyond_five_sigma(const LighthousePoseEstimate& estimate, const LighthouseFromBody& truth) {
  constexpr double kSigmas = 5.0, kRotation_rad = 1.0 * kRadPerDeg, kPosition_m = 0.02;
  const double rotation_rad = rotation_angle_between(estimate.pose.R, truth.R);
  const double position_m = (estimate.pose.t - truth.t).norm();
  return (rotation_rad > kSigmas * estimate.sigma_rotation_rad() && rotation_rad > kRotation_rad) ||
         (position_m > kSigmas * estimate.sigma_position_m() && position_m > kPosition_m);
}

void fly(const sim::LighthouseScenario& scenario, std::uint64_t seed, Fault fault, double fraction, Count& count) {
  sim::LighthouseSimulator simulator(scenario, seed);
  const std::array<KnownStation, 1> stations{{{std::nullopt, std::uint8_t{0}, {}}}};
  const StationSurvey survey{stations, nullptr};
  CalibrationPolicy policy;
  policy.survey = &survey;
  MethodOptions options;
  options.systematic = {};
  const auto tracker = std::make_unique<CalibratedTracker<MethodTracker>>(policy, scenario.target, options);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  FaultyTarget spoil(fault, fraction, seed);
  const auto give = [&] {
    while (decoder->take_ootx()) {
    }
    while (auto sweep = decoder->take_sweep()) {
      spoil(*sweep);
      const auto result = tracker->push(*sweep);
      if (!result) continue;
      ++count.answers;
      if (!result->pose || result->pose->ambiguous()) {
        ++count.refused;
        continue;
      }
      ++count.ok;
      const LighthouseFromBody truth = simulator.truth(0, ticks_to_seconds(result->time_ticks));
      if (!beyond_five_sigma(*result->pose.operator->(), truth)) continue;
      ++count.wrong;
      count.worst_mm = std::max(count.worst_mm, (result->pose->pose.t - truth.t).norm() * kMmPerM);
      count.worst_deg = std::max(count.worst_deg, rotation_angle_between(result->pose->pose.R, truth.R) * kDegPerRad);
    }
  };
  while (const auto pulse = simulator.next()) {
    decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    give();
  }
}

Count score_of(Fault fault, double fraction) {
  Count count;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const double pace = 1.0 + static_cast<double>(seed % 3);
    fly(test::manoeuvre(4.0, 0.4 * pace, 40.0 * pace, seed), seed, fault, fraction, count);
  }
  std::printf("fault %d, %5.1f %%: %6d answers, %6d ok, %5d wrong, worst %.0f mm %.1f deg\n", static_cast<int>(fault),
              100.0 * fraction, count.answers, count.ok, count.wrong, count.worst_mm, count.worst_deg);
  return count;
}

TEST(FaultyTarget, ASoundOneIsAnswered) {
  const Count count = score_of(Fault::kNone, 1.0);
  EXPECT_GT(count.ok, 0.98 * count.answers);
  EXPECT_EQ(count.wrong, 0);
}

TEST(FaultyTarget, WrongTimesGiveNoAnswerThatIsFarOff) {
  for (const double fraction : {0.01, 0.1, 0.5, 1.0}) EXPECT_EQ(score_of(Fault::kWrongTimes, fraction).wrong, 0);
}

TEST(FaultyTarget, ShiftedHitsNowAndThenGiveNoAnswerThatIsFarOff) {
  for (const Fault fault : {Fault::kShiftedSweeps, Fault::kShiftedHits}) {
    const Count count = score_of(fault, 0.01);
    EXPECT_EQ(count.wrong, 0);
    EXPECT_GT(count.ok, count.answers / 2);
  }
}

// Of a target that is wrong all the time few answers leave, and fewer that are far off: common/pharos/motion/README.md
// has how many.
TEST(FaultyTarget, ShiftedHitsOftenAreSuspected) {
  for (const Fault fault : {Fault::kShiftedSweeps, Fault::kShiftedHits, Fault::kSteadyOffset}) {
    const Count count = score_of(fault, 0.1);
    EXPECT_LT(count.ok, count.answers / 4);
    EXPECT_LT(count.wrong, count.answers / 100);
  }
}

}  // namespace
}  // namespace pharos::tracking
