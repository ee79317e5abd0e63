// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Time zero and turn of one rotor after smoothing.
struct SmoothedFlash {
  /// Smoothed time zero minus the flash's start_ticks, ticks.
  double offset_ticks = 0.0;
  double period_ticks = kNominalPeriodTicks;
};

/// What a flash's length says of its lateness: a flash that begins late is short, because its end is not late with it.
/// How much so (0.1 to 0.6 of the missing length) depends on station and receiver, so it is learnt from the flashes.
class FlashLateness {
 public:
  /// Length of the flash minus what flashes of the same code usually have, at most +-100 ticks.
  double length_deviation(const Flash& flash);
  /// Lateness that a deviation stands for, ticks, as something to add to the start: negative for a short flash.
  double correction_ticks(double deviation_ticks) const;
  /// `lateness_ticks`: flash minus its prediction from earlier flashes of the rotor.
  void learn(double deviation_ticks, double lateness_ticks);

 private:
  /// Slope of -lateness over deviation: ratio of two decaying averages.
  struct Slope {
    double product;
    double square;
    double value(double lowest) const;
    void learn(double deviation_ticks, double lateness_ticks, double weight);
  };
  struct Usual {
    double excess_ticks = 0.0;
    int count = 0;
  };
  std::array<Usual, 4> usual_;  // by data and skip: stations are off nominal by some ticks, differently for each code
  Slope common_{18.0, 60.0};
  Slope short_{240.0, 600.0};
};

/// Smooths the flash times of ONE rotor (station and axis) with its earlier flashes; never uses a later one. Push every
/// sweep of that rotor in order, also empty and skipped ones: a skipped sweep's flash is as good as any.
///
/// A steady-state Kalman filter of the rotor's phase and turn: phase gain a, turn gain 0.7 a, turn drawn to its long
/// mean by 0.85 each turn. Rotors wander by 6-10 ticks a turn and flashes jitter by 4-6, differently for each station:
/// so a is adapted until successive innovations are uncorrelated (0.6 <= a <= 1). Light is late, never early: an early
/// innovation counts more, a late one less. Cost: some 60 floating-point operations.
class FlashSmoother {
 public:
  SmoothedFlash push(const Sweep& sweep);

 private:
  void restart(const Sweep& sweep, double correction_ticks);
  void correct(double innovation_ticks);
  SmoothedFlash answer(const Sweep& sweep) const;

  FlashLateness lateness_;
  std::int64_t last_start_ticks_ = 0;
  double phase_ticks_ = 0.0;  // smoothed start minus the last start
  double period_ticks_ = kNominalPeriodTicks;
  double mean_period_ticks_ = kNominalPeriodTicks;
  double gain_ = 0.8;
  double innovation_variance_ = 40.0;
  double last_innovation_ticks_ = 0.0;
  int flashes_ = 0;  // since the last restart, saturating
};

}  // namespace pharos::lighthouse
