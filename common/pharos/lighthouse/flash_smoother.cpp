// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_smoother.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {
namespace {

// Chosen on three recordings of still targets before two pairs of stations, with none kept aside as a check; all of
// them are flat optima (half or twice the value costs 1-3 % of the noise).
constexpr double kUsualLengthFlashes = 48;      // over which a code's usual length is averaged
constexpr double kLargestStepTicks = 32;        // by which one flash may move it
constexpr double kLargestDeviationTicks = 100;  // beyond, the flash was weak, not late
constexpr double kShortBeginTicks = 12;         // deviations between here ...
constexpr double kShortFullTicks = 24;          // ... and here go from the common slope to that of short flashes
constexpr double kCommonSlopeFlashes = 128;     // over which the slopes are learnt
constexpr double kShortSlopeFlashes = 16;
constexpr double kLowestCommonSlope = 0.1;
constexpr double kHighestSlope = 0.75;

constexpr double kPeriodGainRatio = 0.7;
constexpr double kPeriodMemory = 0.85;  // of a turn's departure from the mean, per turn
constexpr double kMeanPeriodFlashes = 64;
constexpr double kVarianceFlashes = 64;
constexpr double kGainStep = 0.01;
constexpr double kLowestGain = 0.6;
constexpr double kHighestGain = 1.0;
constexpr double kAsymmetry = 0.2;            // of what exceeds one standard deviation
constexpr double kOutlierTicks = 150;         // an innovation beyond starts anew
constexpr std::int32_t kLongestGapTurns = 8;  // after more the last flash predicts nothing useful
constexpr int kWarmUp = 8;                    // flashes before anything is learnt
constexpr int kSettled = 16;
constexpr double kPeriodSlack = 0.001;  // rotors are held to 60 Hz

std::size_t code_index(const Flash& flash) { return (flash.data ? 1U : 0U) + (flash.skip ? 2U : 0U); }

}  // namespace

double FlashLateness::length_deviation(const Flash& flash) {
  Usual& usual = usual_[code_index(flash)];
  const double excess =
      static_cast<double>(flash.length_ticks) - kFlashLengthTicks[flash_code(flash.axis, flash.data, flash.skip)];
  if (usual.count == 0) {
    double sum = 0.0;
    int known = 0;
    for (const Usual& other : usual_) {
      if (other.count == 0) continue;
      sum += other.excess_ticks;
      ++known;
    }
    usual.excess_ticks = known > 0 ? sum / known : excess;
  }
  const double deviation = excess - usual.excess_ticks;
  if (usual.count < kUsualLengthFlashes) ++usual.count;
  usual.excess_ticks += std::clamp(deviation, -kLargestStepTicks, kLargestStepTicks) / usual.count;
  return std::clamp(deviation, -kLargestDeviationTicks, kLargestDeviationTicks);
}

double FlashLateness::Slope::value(double lowest) const { return std::clamp(product / square, lowest, kHighestSlope); }

void FlashLateness::Slope::learn(double deviation_ticks, double lateness_ticks, double weight) {
  product += (-lateness_ticks * deviation_ticks - product) * weight;
  square = std::max(1.0, square + (deviation_ticks * deviation_ticks - square) * weight);
}

double FlashLateness::correction_ticks(double deviation_ticks) const {
  const double share =
      std::clamp((-deviation_ticks - kShortBeginTicks) / (kShortFullTicks - kShortBeginTicks), 0.0, 1.0);
  const double slope = (1.0 - share) * common_.value(kLowestCommonSlope) + share * short_.value(0.0);
  return slope * deviation_ticks;
}

void FlashLateness::learn(double deviation_ticks, double lateness_ticks) {
  if (deviation_ticks > -kShortBeginTicks) {
    common_.learn(deviation_ticks, lateness_ticks, 1.0 / kCommonSlopeFlashes);
  } else {
    const double share = std::min(1.0, (-deviation_ticks - kShortBeginTicks) / (kShortFullTicks - kShortBeginTicks));
    short_.learn(deviation_ticks, lateness_ticks, share / kShortSlopeFlashes);
  }
}

void FlashSmoother::restart(const Sweep& sweep, double correction_ticks) {
  phase_ticks_ = correction_ticks;
  flashes_ = 1;
  last_innovation_ticks_ = 0.0;
  if (sweep.period_sixteenth_ticks > 0) period_ticks_ = static_cast<double>(sweep.period_sixteenth_ticks) / 16.0;
  mean_period_ticks_ = period_ticks_;
}

void FlashSmoother::correct(double innovation_ticks) {
  const double one_over_count = 1.0 / flashes_;
  double excess = 0.0;
  if (flashes_ > kWarmUp) {
    const double deviation = std::sqrt(innovation_variance_);
    const double clipped = std::clamp(innovation_ticks, -3.0 * deviation, 3.0 * deviation);
    innovation_variance_ =
        std::max(1.0, innovation_variance_ + (clipped * clipped - innovation_variance_) / kVarianceFlashes);
    gain_ = std::clamp(gain_ + kGainStep * clipped * last_innovation_ticks_ / innovation_variance_, kLowestGain,
                       kHighestGain);
    last_innovation_ticks_ = clipped;
    if (flashes_ >= kSettled) {
      excess = kAsymmetry * (std::min(innovation_ticks + deviation, 0.0) - std::max(innovation_ticks - deviation, 0.0));
    }
  }
  phase_ticks_ += std::max(gain_, one_over_count) * innovation_ticks + excess;
  period_ticks_ += std::max(kPeriodGainRatio * gain_, flashes_ < kWarmUp ? one_over_count : 0.0) * innovation_ticks;
  mean_period_ticks_ += (period_ticks_ - mean_period_ticks_) / std::min<double>(flashes_, kMeanPeriodFlashes);
}

SmoothedFlash FlashSmoother::answer(const Sweep& sweep) const {
  SmoothedFlash smoothed{phase_ticks_, period_ticks_};
  const bool credible = std::abs(period_ticks_ - kNominalPeriodTicks) < kPeriodSlack * kNominalPeriodTicks;
  if (flashes_ < 3 || !credible) smoothed.period_ticks = static_cast<double>(sweep.period_sixteenth_ticks) / 16.0;
  if (!(smoothed.period_ticks > 0.0)) smoothed.period_ticks = kNominalPeriodTicks;
  return smoothed;
}

SmoothedFlash FlashSmoother::push(const Sweep& sweep) {
  const double deviation = lateness_.length_deviation(sweep.flash);
  const double correction = lateness_.correction_ticks(deviation);
  const std::int64_t elapsed = sweep.flash.start_ticks - last_start_ticks_;
  const bool first = flashes_ == 0;
  last_start_ticks_ = sweep.flash.start_ticks;
  if (first || elapsed <= 0 || elapsed > std::int64_t{kLongestGapTurns + 1} * kTurnTicks) {
    restart(sweep, correction);
    return answer(sweep);
  }
  const auto turns = static_cast<std::int32_t>((elapsed + kTurnTicks / 2) / kTurnTicks);
  for (std::int32_t turn = 0; turn < turns; ++turn) {
    period_ticks_ = mean_period_ticks_ + kPeriodMemory * (period_ticks_ - mean_period_ticks_);
  }
  phase_ticks_ += turns * period_ticks_ - static_cast<double>(elapsed);
  const double innovation = correction - phase_ticks_;
  if (turns == 0 || std::abs(innovation) > kOutlierTicks) {
    restart(sweep, correction);
    return answer(sweep);
  }
  if (flashes_ > kWarmUp) lateness_.learn(deviation, -phase_ticks_);
  flashes_ = std::min(flashes_ + 1, 1000);
  correct(innovation);
  return answer(sweep);
}

}  // namespace pharos::lighthouse
