// SPDX-License-Identifier: Apache-2.0
#pragma once

// INTERFACE AGREED (track uses these names), implementation follows: causal smoothing of one rotor's flashes.
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Time zero and turn of one rotor after smoothing.
struct SmoothedFlash {
  /// Smoothed time zero minus the flash's start_ticks, ticks.
  double offset_ticks = 0.0;
  double period_ticks = kNominalPeriodTicks;
};

/// Smooths the flash times of ONE rotor (station and axis) with its earlier flashes; never uses a later one. Push every
/// sweep of that rotor in order, also empty and skipped ones.
class FlashSmoother {
 public:
  SmoothedFlash push(const Sweep& sweep);
};

}  // namespace pharos::lighthouse
