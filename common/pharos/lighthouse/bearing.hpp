// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/flash_smoother.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// One hit as an angle: raw theta = 2 pi (centre - flash) / revolution (a quarter is pi/2), before the station model.
struct Bearing {
  std::int64_t time_ticks = 0;  // centre of the hit, 20 ns ticks, unwrapped
  double theta_rad = 0.0;
  std::uint16_t width_ticks = 0;
  std::uint8_t sensor = 0;
};

using SweepBearings = StaticVector<Bearing, kMaxHitsPerSweep>;

/// Bearings from the flash and the period as measured.
SweepBearings bearings_of(const Sweep& sweep);

/// Bearings from the smoothed time zero and period of the sweep's rotor.
SweepBearings bearings_of(const Sweep& sweep, const SmoothedFlash& smoothed);

/// The same in integers, to 2e-9 rad: for cores without a floating-point unit, at a tenth of the cost.
SweepBearings fixed_bearings_of(const Sweep& sweep, const SmoothedFlash& smoothed);

}  // namespace pharos::lighthouse
