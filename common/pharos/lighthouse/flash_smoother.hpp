// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/fixed_point.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Time zero and turn of one rotor after smoothing.
struct SmoothedFlash {
  /// Smoothed time zero minus the flash's start_ticks, ticks.
  double offset_ticks = 0.0;
  double period_ticks = kNominalPeriod_ticks;
};

/// Ticks in units of 2^-16: what the smoothing counts in, so that it tells the same on every processor and costs a core
/// without a floating-point unit little. Its numbers stay within some hundreds; rounding is a thousandth of the noise.
using Q16 = std::int32_t;

/// What a flash's length says of its lateness: a flash that begins late is short, because its end is not late with it.
/// How much so (0.1 to 0.6 of the missing length) depends on station and receiver, so it is learnt from the flashes.
class FlashLateness {
 public:
  /// Length of the flash minus what flashes of the same code usually have, at most +-100 ticks.
  Q16 length_deviation(const Flash& flash);
  /// Lateness that a deviation stands for, ticks, as something to add to the start: negative for a short flash.
  Q16 correction(Q16 deviation) const;
  /// `lateness`: flash minus its prediction from earlier flashes of the rotor, at most +-300 ticks.
  void learn(Q16 deviation, Q16 lateness);

 private:
  /// Slope of -lateness over deviation: ratio of two decaying averages, in square ticks.
  struct Slope {
    Q16 product;
    Q16 square;
    fixed::Q30 value(fixed::Q30 lowest) const;
    void learn(Q16 deviation, Q16 lateness, fixed::Q30 weight);
  };
  struct MeanExcess {
    Q16 excess = 0;
    std::int32_t count = 0;
  };
  std::array<MeanExcess, 4>
      mean_excess_;  // by data and skip: stations are off nominal by some ticks, differently for each code
  Slope common_{18 << 16, 60 << 16};
  Slope short_{240 << 16, 600 << 16};
};

/// Smooths the flash times of ONE rotor (station and axis) with its earlier flashes; never uses a later one. Push every
/// sweep of that rotor in order, also empty and skipped ones: a skipped sweep's flash is as good as any.
///
/// A steady-state Kalman filter of the rotor's phase and turn: phase gain a, turn gain 0.7 a, turn drawn to its long
/// mean by 0.85 each turn. Rotors wander by 6-10 ticks a turn and flashes jitter by 4-6, differently for each station:
/// so a is adapted until successive innovations are uncorrelated (0.6 <= a <= 1). Light is late, never early: an early
/// innovation counts more, a late one less. Cost: some 1,500 instructions on RV32IM.
class FlashSmoother {
 public:
  SmoothedFlash push(const Sweep& sweep);

 private:
  void restart(const Sweep& sweep, Q16 correction);
  void correct(Q16 innovation);
  SmoothedFlash filtered(const Sweep& sweep) const;

  FlashLateness lateness_;
  std::int64_t last_start_ticks_ = 0;
  Q16 phase_ = 0;        // smoothed start minus the last start
  Q16 period_ = 0;       // beyond the nominal turn
  Q16 mean_period_ = 0;  // the same
  fixed::Q30 gain_ = fixed::kOne / 5 * 4;
  Q16 innovation_variance_ = 40 << 16;  // square ticks
  Q16 last_innovation_ = 0;
  std::int32_t flashes_ = 0;  // since the last restart, saturating
};

}  // namespace pharos::lighthouse
