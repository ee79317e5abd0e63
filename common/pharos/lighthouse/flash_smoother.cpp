// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_smoother.hpp"

#include <algorithm>

#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {
namespace {

using fixed::kOne;
using fixed::Q30;
using fixed::times;
using fixed::times_wide;

constexpr Q16 ticks(double value) { return static_cast<Q16>(value * 65536.0); }
constexpr Q30 fraction(double value) { return static_cast<Q30>(value * kOne); }

// Chosen on three recordings of stationary targets before two pairs of stations, with none kept as a check; all of them
// are flat optima (half or twice the value costs 1-3 % of the noise).
constexpr std::int32_t kMeanLengthFlashes = 48;     // over which a code's usual length is averaged
constexpr Q16 kLargestStep = ticks(32);             // by which one flash may move it
constexpr Q16 kLargestDeviation = ticks(100);       // beyond, the flash was weak, not late
constexpr Q16 kShortBegin = ticks(12);              // deviations between here ...
constexpr Q16 kShortFull = ticks(24);               // ... and here go from the common slope to that of short flashes
constexpr Q30 kCommonWeight = fraction(1.0 / 128);  // of a flash in the estimated slopes
constexpr Q30 kShortWeight = fraction(1.0 / 16);
constexpr Q30 kLowestCommonSlope = fraction(0.1);
constexpr Q30 kHighestSlope = fraction(0.75);

constexpr Q30 kPeriodGainRatio = fraction(0.7);
constexpr Q30 kPeriodMemory = fraction(0.85);  // of a period's departure from the mean, per revolution
constexpr std::int32_t kMeanPeriodFlashes = 64;
constexpr std::int32_t kVarianceFlashes = 64;
constexpr Q30 kGainStep = fraction(0.01);
constexpr Q30 kLowestGain = fraction(0.6);
constexpr Q30 kHighestGain = kOne;
constexpr Q30 kAsymmetry = fraction(0.2);     // of what exceeds one standard deviation
constexpr Q16 kOutlier = ticks(150);          // an innovation beyond it restarts the filter
constexpr std::int32_t kLongestGapTurns = 8;  // after more the last flash predicts nothing useful
constexpr int kWarmUp = 8;                    // flashes before anything is estimated
constexpr int kSettled = 16;
constexpr Q16 kPeriodSlack = ticks(0.001 * kNominalPeriod_ticks);  // rotors are held to 60 Hz
constexpr Q16 kWidestPeriod = ticks(16'000);  // limit of a sweep's measured period; far beyond every plausible one
constexpr auto kNominalPeriod = static_cast<std::int64_t>(kNominalPeriod_ticks * 65536.0);

std::size_t code_index(const Flash& flash) { return (flash.data ? 1U : 0U) + (flash.skip ? 2U : 0U); }

// Interpolation weight of a deviation between the common slope and that of short flashes.
Q30 shortness(Q16 deviation) {
  constexpr std::int64_t kPerTick = kOne / ((kShortFull - kShortBegin) >> 16);
  const std::int64_t way = std::int64_t{-deviation} - kShortBegin;
  return static_cast<Q30>(std::clamp<std::int64_t>((way * kPerTick) >> 16, 0, kOne));
}

Q16 square(Q16 a, Q16 b) { return static_cast<Q16>(fixed::product(a, b) >> 16); }

// Square root in ticks.
Q16 root(Q16 square_ticks) {
  const fixed::Root root = fixed::root_of(std::int64_t{square_ticks} << 28);
  return root.root >> (root.binary_exponent + 6);
}

Q30 ratio(std::int64_t a, std::int32_t b) { return static_cast<Q30>(std::clamp<std::int64_t>(a / b, -kOne, kOne)); }

}  // namespace

Q16 FlashLateness::length_deviation(const Flash& flash) {
  MeanExcess& usual = mean_excess_[code_index(flash)];
  const std::int32_t excess_ticks =
      flash.length_ticks - kFlashLength_ticks[flash_code(flash.axis, flash.data, flash.skip)];
  // A flash is no longer than some thousand ticks: anything else is rejected.
  const Q16 excess = std::clamp<std::int32_t>(excess_ticks, -10'000, 10'000) * 65536;
  if (usual.count == 0) {
    std::int64_t sum = 0;
    std::int32_t known = 0;
    for (const MeanExcess& other : mean_excess_) {
      if (other.count == 0) continue;
      sum += other.excess;
      ++known;
    }
    usual.excess = known > 0 ? static_cast<Q16>(sum / known) : excess;
  }
  const std::int64_t deviation = std::int64_t{excess} - usual.excess;
  if (usual.count < kMeanLengthFlashes) ++usual.count;
  usual.excess += fixed::clamped(deviation, kLargestStep) / usual.count;
  return fixed::clamped(deviation, kLargestDeviation);
}

Q30 FlashLateness::Slope::value(Q30 lowest) const {
  return std::clamp(ratio(std::int64_t{product} * kOne, this->square), lowest, kHighestSlope);
}

void FlashLateness::Slope::learn(Q16 deviation, Q16 lateness, Q30 weight) {
  const auto towards = [weight](Q16& average, Q16 value) {
    average += static_cast<Q16>(times_wide(std::int64_t{value} - average, weight));
  };
  towards(product, lighthouse::square(-lateness, deviation));
  towards(square, lighthouse::square(deviation, deviation));
  square = std::max(square, ticks(1));
}

Q16 FlashLateness::correction(Q16 deviation) const {
  const Q30 to_short = shortness(deviation);
  Q30 slope = 0;
  if (to_short != kOne) slope += times(common_.value(kLowestCommonSlope), kOne - to_short);
  if (to_short != 0) slope += times(short_.value(0), to_short);
  return times(deviation, slope);
}

void FlashLateness::learn(Q16 deviation, Q16 lateness) {
  if (deviation > -kShortBegin) {
    common_.learn(deviation, lateness, kCommonWeight);
  } else {
    short_.learn(deviation, lateness, times(shortness(deviation), kShortWeight));
  }
}

void FlashSmoother::restart(const Sweep& sweep, Q16 correction) {
  phase_ = correction;
  flashes_ = 1;
  last_innovation_ = 0;
  if (sweep.period_sixteenth_ticks > 0) {
    const std::int64_t period = std::int64_t{sweep.period_sixteenth_ticks} * 4096 - kNominalPeriod;
    period_ = fixed::clamped(period, kWidestPeriod);
  }
  mean_period_ = period_;
}

void FlashSmoother::correct(Q16 innovation) {
  const Q30 one_over_count = kOne / flashes_;
  Q16 excess = 0;
  if (flashes_ > kWarmUp) {
    const Q16 deviation = root(innovation_variance_);
    const Q16 clipped = std::clamp(innovation, -3 * deviation, 3 * deviation);
    innovation_variance_ += (square(clipped, clipped) - innovation_variance_) / kVarianceFlashes;
    innovation_variance_ = std::max(innovation_variance_, ticks(1));
    // 2^-24: neither exceeds three standard deviations.
    const std::int64_t similarity = (fixed::product(clipped, last_innovation_) * 256) / innovation_variance_;
    gain_ += static_cast<Q30>((similarity * kGainStep) >> 24);
    gain_ = std::clamp(gain_, kLowestGain, kHighestGain);
    last_innovation_ = clipped;
    if (flashes_ >= kSettled) {
      excess = times(std::min<Q16>(innovation + deviation, 0) - std::max<Q16>(innovation - deviation, 0), kAsymmetry);
    }
  }
  phase_ += times(innovation, std::max(gain_, one_over_count)) + excess;
  const Q30 period_gain = times(kPeriodGainRatio, gain_);
  period_ += times(innovation, flashes_ < kWarmUp ? std::max(period_gain, one_over_count) : period_gain);
  mean_period_ += (period_ - mean_period_) / std::min(flashes_, kMeanPeriodFlashes);
}

SmoothedFlash FlashSmoother::filtered(const Sweep& sweep) const {
  SmoothedFlash smoothed{fixed::to_double(phase_, 16), 0.0};
  if (flashes_ >= 3 && period_ < kPeriodSlack && period_ > -kPeriodSlack) {
    smoothed.period_ticks = fixed::to_double(kNominalPeriod + period_, 16);
  } else if (sweep.period_sixteenth_ticks > 0) {
    smoothed.period_ticks = fixed::to_double(sweep.period_sixteenth_ticks, 4);
  } else {
    smoothed.period_ticks = kNominalPeriod_ticks;
  }
  return smoothed;
}

SmoothedFlash FlashSmoother::push(const Sweep& sweep) {
  const Q16 deviation = lateness_.length_deviation(sweep.flash);
  const Q16 correction = lateness_.correction(deviation);
  const std::int64_t elapsed = sweep.flash.start_ticks - last_start_ticks_;
  const bool first = flashes_ == 0;
  last_start_ticks_ = sweep.flash.start_ticks;
  if (first || elapsed <= 0 || elapsed > std::int64_t{kLongestGapTurns + 1} * kTurn_ticks) {
    restart(sweep, correction);
    return filtered(sweep);
  }
  const std::int32_t turns = (static_cast<std::int32_t>(elapsed) + kTurn_ticks / 2) / kTurn_ticks;
  for (std::int32_t turn = 0; turn < turns; ++turn) {
    period_ = mean_period_ + times(period_ - mean_period_, kPeriodMemory);
  }
  const std::int64_t phase = phase_ + turns * (kNominalPeriod + period_) - elapsed * 65536;
  const std::int64_t innovation = correction - phase;
  if (turns == 0 || innovation > kOutlier || innovation < -kOutlier) {
    restart(sweep, correction);
    return filtered(sweep);
  }
  phase_ = static_cast<Q16>(phase);
  if (flashes_ > kWarmUp) lateness_.learn(deviation, -phase_);
  flashes_ = std::min<std::int32_t>(flashes_ + 1, 1000);
  correct(static_cast<Q16>(innovation));
  return filtered(sweep);
}

}  // namespace pharos::lighthouse
