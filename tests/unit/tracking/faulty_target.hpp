// SPDX-License-Identifier: Apache-2.0
#pragma once

// A target whose frames are whole and whose numbers are not: flashes told at wrong times, hits that are shifted.

#include <cmath>
#include <cstdio>
#include <memory>

#include "pharos/tracking/calibrated_tracker.hpp"
#include "pharos/tracking/method_tracker.hpp"
#include "tests/unit/motion/flight.hpp"

namespace pharos::test {

using namespace tracking;

enum class Fault : std::uint8_t { kNone, kWrongTimes, kShiftedSweeps, kShiftedHits, kSteadyOffset };

inline double log_uniform(sim::RandomStream& random, double low, double high) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

inline double either_sign(sim::RandomStream& random) { return random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0; }

/// Spoils a fraction of a target's frames.
class FaultyTarget {
 public:
  /// From `onset_s` after the start on.
  FaultyTarget(Fault fault, double fraction, double onset_s, std::uint64_t seed)
      : fault_(fault), fraction_(fraction), onset_s_(onset_s), random_(seed, "faulty target") {
    for (double& offset : steady_) offset = either_sign(random_) * log_uniform(random_, 100.0, 10'000.0);
  }
  void operator()(lighthouse::Sweep& sweep) {
    if (random_.uniform(0.0, 1.0) >= fraction_) return;
    if (ticks_to_seconds(sweep.flash.start_ticks) < kStart_s + onset_s_) return;
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

  static constexpr double kStart_s = 1.0;  // of the simulated counter

  Fault fault_;
  double fraction_, onset_s_;
  sim::RandomStream random_;
  std::array<double, kMaxSensors> steady_{};
};

struct Count {
  int answers = 0, ok = 0, ambiguous = 0, refused = 0, wrong = 0;
  double worst_mm = 0.0, worst_deg = 0.0;
};

inline bool beyond_five_sigma(const LighthousePoseEstimate& estimate, const LighthouseFromBody& truth) {
  constexpr double kSigmas = 5.0, kRotation_rad = 1.0 * kRadPerDeg, kPosition_m = 0.02;
  const double rotation_rad = rotation_angle_between(estimate.pose.R, truth.R);
  const double position_m = (estimate.pose.t - truth.t).norm();
  return (rotation_rad > kSigmas * estimate.sigma_rotation_rad() && rotation_rad > kRotation_rad) ||
         (position_m > kSigmas * estimate.sigma_position_m() && position_m > kPosition_m);
}

inline void fly(const sim::LighthouseScenario& scenario, std::uint64_t seed, Fault fault, double fraction,
                double onset_s, Count& count) {
  sim::LighthouseSimulator simulator(scenario, seed);
  const std::array<KnownStation, 1> stations{{{std::nullopt, std::uint8_t{0}, {}}}};
  const StationSurvey survey{stations, nullptr};
  CalibrationPolicy policy;
  policy.survey = &survey;
  MethodOptions options;
  options.systematic = {};
  const auto tracker = std::make_unique<CalibratedTracker<MethodTracker>>(policy, scenario.target, options);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  FaultyTarget spoil(fault, fraction, onset_s, seed);
  const auto give = [&] {
    while (decoder->take_ootx()) {
    }
    while (auto sweep = decoder->take_sweep()) {
      spoil(*sweep);
      const auto result = tracker->push(*sweep);
      if (!result) continue;
      ++count.answers;
      if (!result->pose) {
        ++count.refused;
        continue;
      }
      if (result->pose->ambiguous()) {
        ++count.ambiguous;
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

/// A manoeuvre of 4 s.
inline sim::LighthouseScenario faulty_flight(std::uint64_t seed) {
  const double pace = 1.0 + static_cast<double>(seed % 3);
  return manoeuvre(4.0, 0.4 * pace, 40.0 * pace, seed);
}

/// Flights with these seeds; those with wrong answers are named.
inline Count score_of(Fault fault, double fraction, double onset_s = 0.0, std::uint64_t first = 1,
                      std::uint64_t last = 10, sim::LighthouseScenario (*flight)(std::uint64_t) = faulty_flight) {
  Count count;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const int before = count.wrong;
    fly(flight(seed), seed, fault, fraction, onset_s, count);
    if (count.wrong > before) {
      std::printf("flight %llu: %d wrong\n", static_cast<unsigned long long>(seed), count.wrong - before);
    }
  }
  std::printf("fault %d, %5.1f %% from %.0f s: %6d answers, %6d ok, %6d ambiguous, %5d wrong, worst %.0f mm %.1f deg\n",
              static_cast<int>(fault), 100.0 * fraction, onset_s, count.answers, count.ok, count.ambiguous, count.wrong,
              count.worst_mm, count.worst_deg);
  return count;
}

}  // namespace pharos::test
