// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/bearing.hpp"

#include "pharos/base/units.hpp"

namespace pharos::lighthouse {
namespace {

SweepBearings bearings_from(const Sweep& sweep, double offset_ticks, double period_ticks) {
  SweepBearings bearings;
  if (!(period_ticks > 0.0)) return bearings;
  for (const Hit& hit : sweep.hits) {
    // The integer part first: what is converted is small and exact.
    const double after_flash_ticks = 0.5 * static_cast<double>(hit.centre_half_ticks) - offset_ticks;
    bearings.push_back({sweep.flash.start_ticks + hit.centre_half_ticks / 2, kTwoPi * after_flash_ticks / period_ticks,
                        hit.width_ticks, hit.sensor});
  }
  return bearings;
}

}  // namespace

SweepBearings bearings_of(const Sweep& sweep) {
  return bearings_from(sweep, 0.0, static_cast<double>(sweep.period_sixteenth_ticks) / 16.0);
}

SweepBearings bearings_of(const Sweep& sweep, const SmoothedFlash& smoothed) {
  return bearings_from(sweep, smoothed.offset_ticks, smoothed.period_ticks);
}

}  // namespace pharos::lighthouse
