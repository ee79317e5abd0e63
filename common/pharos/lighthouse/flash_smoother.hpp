// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/fixed_point.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Time zero and revolution of one rotor after smoothing.
struct SmoothedFlash {
  /// Smoothed time zero minus the flash's start_ticks, ticks.
  double offset_ticks = 0.0;
  double period_ticks = kNominalPeriod_ticks;
};

/// Ticks in units of 2^-16, in which the smoothing computes: the same result on every processor, and cheap without a
/// floating-point unit. Values stay within some hundreds; rounding is a thousandth of the noise.
using Q16 = std::int32_t;

/// Estimates a flash's lateness from its length: a flash that begins late is short, because its end is not late with
/// it. The slope (0.1 to 0.6 of the missing length) depends on station and receiver, so it is estimated from the
/// flashes.
class FlashLateness {
 public:
  /// Length of the flash minus the usual one of the same code, at most +-100 ticks.
  Q16 length_deviation(const Flash& flash);
  /// Lateness for a deviation, ticks, to be added to the start: negative for a short flash.
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

/// Smooths the flash times of ONE rotor (station and axis) with its earlier flashes; causal. Push every sweep of that
/// rotor in order, also empty and skipped ones: a skipped sweep's flash is as good as any.
///
/// A steady-state Kalman filter of the rotor's phase and period: phase gain a, period gain 0.7 a, period returning to
/// its long mean by 0.85 each revolution. Rotors wander by 6-10 ticks a revolution and flashes jitter by 4-6,
/// differently for each station: so a is adapted until successive innovations are uncorrelated (0.6 <= a <= 1). Edges
/// are late, never early: an early innovation counts more, a late one less. Cost: some 1,500 instructions on RV32IM.
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
  Q16 period_ = 0;       // beyond the nominal revolution
  Q16 mean_period_ = 0;  // the same
  fixed::Q30 gain_ = fixed::kOne / 5 * 4;
  Q16 innovation_variance_ = 40 << 16;  // square ticks
  Q16 last_innovation_ = 0;
  std::int32_t flashes_ = 0;  // since the last restart, saturating
};

}  // namespace pharos::lighthouse
