// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/bearing.hpp"

namespace pharos::lighthouse {
namespace {

/// Flashes of one rotor whose true time zero is known.
struct Rotor {
  std::vector<Sweep> sweeps;
  std::vector<double> truth_ticks;
};

struct RotorNoise {
  double wander_ticks = 6.0;    // of the rotor's period, per turn, a mean-reverting walk
  double jitter_ticks = 5.0;    // of the flash, independent of its length
  double lateness_ticks = 0.0;  // of the flash, missing from its length
  double missed = 0.0;
};

Rotor rotor_of(const RotorNoise& noise, std::size_t flashes, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution bit(0.5);
  std::bernoulli_distribution missed(noise.missed);
  Rotor rotor;
  double start = 1e9;
  double departure = 0.0;
  for (std::size_t i = 0; i < flashes; ++i) {
    departure = 0.8 * departure + noise.wander_ticks * normal(random);
    start += 833'340.0 + departure;
    const double late = noise.lateness_ticks * std::abs(normal(random));
    Sweep sweep;
    sweep.flash.start_ticks = std::llround(start + noise.jitter_ticks * normal(random) + late);
    sweep.flash.data = bit(random);
    sweep.flash.skip = i % 2 == 1;
    sweep.flash.length_ticks = 3'140 + (sweep.flash.data ? 1'042 : 0) + (sweep.flash.skip ? 2'083 : 0) -
                               static_cast<std::int32_t>(std::lround(2.0 * late));
    sweep.period_sixteenth_ticks = 13'333'440;
    if (missed(random)) continue;
    rotor.sweeps.push_back(sweep);
    rotor.truth_ticks.push_back(start);
  }
  return rotor;
}

struct Errors {
  double raw = 0.0;
  double smoothed = 0.0;
  double period = 0.0;
};

/// RMS about the mean, after the first 100 flashes.
Errors errors_of(const Rotor& rotor) {
  FlashSmoother smoother;
  std::vector<double> raw;
  std::vector<double> smoothed;
  Errors errors;
  for (std::size_t i = 0; i < rotor.sweeps.size(); ++i) {
    const SmoothedFlash flash = smoother.push(rotor.sweeps[i]);
    if (i < 100) continue;
    const double error = static_cast<double>(rotor.sweeps[i].flash.start_ticks) - rotor.truth_ticks[i];
    raw.push_back(error);
    smoothed.push_back(error + flash.offset_ticks);
    errors.period = std::max(errors.period, std::abs(flash.period_ticks - 833'340.0));
  }
  const auto deviation = [](const std::vector<double>& values) {
    double mean = 0.0;
    double square = 0.0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) square += (value - mean) * (value - mean) / static_cast<double>(values.size());
    return std::sqrt(square);
  };
  errors.raw = deviation(raw);
  errors.smoothed = deviation(smoothed);
  return errors;
}

TEST(FlashSmoother, LeavesASteadyRotorAlone) {
  const Errors errors = errors_of(rotor_of({0.0, 0.0, 0.0, 0.0}, 500, 1));
  EXPECT_LT(errors.smoothed, 0.5);  // rounding to ticks
  EXPECT_LT(errors.period, 1.0);
}

TEST(FlashSmoother, QuietensAJitteryFlash) {
  const Errors errors = errors_of(rotor_of({2.0, 8.0, 0.0, 0.0}, 4000, 2));
  EXPECT_NEAR(errors.raw, 8.0, 0.5);
  EXPECT_LT(errors.smoothed, 0.85 * errors.raw);
}

TEST(FlashSmoother, DoesNoHarmToARotorThatWandersMoreThanItsFlashJitters) {
  const Errors errors = errors_of(rotor_of({10.0, 2.0, 0.0, 0.0}, 4000, 3));
  EXPECT_LT(errors.smoothed, 1.25 * errors.raw);  // 2 ticks are 3 arcsec
}

TEST(FlashSmoother, LearnsLatenessFromLength) {
  const Errors errors = errors_of(rotor_of({5.0, 1.0, 12.0, 0.0}, 4000, 4));
  EXPECT_GT(errors.raw, 6.5);
  EXPECT_LT(errors.smoothed, 0.5 * errors.raw);
}

TEST(FlashSmoother, BearsMissedFlashesAndOutliers) {
  Rotor rotor = rotor_of({4.0, 6.0, 0.0, 0.1}, 4000, 5);
  for (std::size_t i = 200; i < rotor.sweeps.size(); i += 97) rotor.sweeps[i].flash.start_ticks += 120;
  const Rotor clean = rotor_of({4.0, 6.0, 0.0, 0.1}, 4000, 5);
  FlashSmoother with_outliers;
  FlashSmoother without;
  double worst = 0.0;
  for (std::size_t i = 0; i < rotor.sweeps.size(); ++i) {
    const bool outlier = i >= 200 && (i - 200) % 97 == 0;
    const double a = with_outliers.push(rotor.sweeps[i]).offset_ticks;
    const double b = without.push(clean.sweeps[i]).offset_ticks;
    const bool shortly_after = i >= 200 && (i - 200) % 97 < 12;
    if (!outlier && !shortly_after && i > 200) worst = std::max(worst, std::abs(a - b));
  }
  EXPECT_LT(worst, 12.0);
}

TEST(FlashSmoother, UsesOnlyThePast) {
  const Rotor rotor = rotor_of({6.0, 5.0, 5.0, 0.05}, 300, 6);
  FlashSmoother whole;
  std::vector<double> offsets;
  for (const Sweep& sweep : rotor.sweeps) offsets.push_back(whole.push(sweep).offset_ticks);
  for (const std::size_t end : {std::size_t{10}, std::size_t{100}, std::size_t{250}}) {
    FlashSmoother cut;
    double last = 0.0;
    for (std::size_t i = 0; i <= end; ++i) last = cut.push(rotor.sweeps[i]).offset_ticks;
    EXPECT_EQ(last, offsets[end]);
  }
}

TEST(FlashSmoother, StartsAnewAfterAGapOrAJump) {
  FlashSmoother smoother;
  const Rotor rotor = rotor_of({0.0, 0.0, 0.0, 0.0}, 60, 7);
  for (const Sweep& sweep : rotor.sweeps) smoother.push(sweep);
  for (const std::int64_t jump :
       {std::int64_t{50'000'000}, std::int64_t{833'333 + 400'000}, std::int64_t{-900'000'000}}) {
    Sweep sweep = rotor.sweeps.back();
    sweep.flash.start_ticks += jump;
    EXPECT_NEAR(smoother.push(sweep).offset_ticks, 0.0, 0.5) << jump;
  }
}

TEST(FlashSmoother, TheFirstFlashStandsAsItIs) {
  FlashSmoother smoother;
  Sweep sweep;
  sweep.flash.start_ticks = 123;
  sweep.flash.length_ticks = 3'200;
  sweep.period_sixteenth_ticks = 13'333'000;
  const SmoothedFlash first = smoother.push(sweep);
  EXPECT_EQ(first.offset_ticks, 0.0);
  EXPECT_DOUBLE_EQ(first.period_ticks, 13'333'000 / 16.0);
}

TEST(Bearing, AQuarterTurnIsAQuarterTurn) {
  Sweep sweep;
  sweep.flash.start_ticks = 1'000;
  sweep.period_sixteenth_ticks = 16 * 800'000;
  sweep.hits.push_back({5, 120, 2 * 200'000});
  sweep.hits.push_back({6, 121, 2 * 200'000 + 1});
  const SweepBearings raw = bearings_of(sweep);
  ASSERT_EQ(raw.size(), 2U);
  EXPECT_DOUBLE_EQ(raw[0].theta_rad, kPi / 2);
  EXPECT_EQ(raw[0].time_ticks, 201'000);
  EXPECT_EQ(raw[0].sensor, 5);
  EXPECT_EQ(raw[0].width_ticks, 120);
  EXPECT_NEAR(raw[1].theta_rad - raw[0].theta_rad, kPi / 800'000, 1e-12);  // half a tick
  // The true flash was 8 ticks later: the hit is 8 ticks nearer to it.
  const SweepBearings smoothed = bearings_of(sweep, {8.0, 800'000.0});
  EXPECT_NEAR(raw[0].theta_rad - smoothed[0].theta_rad, 8 * kTwoPi / 800'000, 1e-12);
}

TEST(Bearing, WithoutAPeriodThereIsNone) {
  Sweep sweep;
  sweep.hits.push_back({5, 120, 400'000});
  EXPECT_TRUE(bearings_of(sweep).empty());
  EXPECT_TRUE(bearings_of(sweep, {0.0, 0.0}).empty());
  EXPECT_TRUE(bearings_of(sweep, {0.0, std::nan("")}).empty());
}

}  // namespace
}  // namespace pharos::lighthouse
