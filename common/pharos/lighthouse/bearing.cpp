// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/bearing.hpp"

#include "pharos/base/fixed_point.hpp"
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

SweepBearings fixed_bearings_of(const Sweep& sweep, const SmoothedFlash& smoothed) {
  // Periods are within 1 % of nominal, or the integers do not apply; offsets are some hundred ticks.
  constexpr double kSlack = 0.01 * kNominalPeriod_ticks, kLargestOffset = 1000.0;
  const double beyond = smoothed.period_ticks - kNominalPeriod_ticks;
  if (!(beyond > -kSlack && beyond < kSlack && smoothed.offset_ticks > -kLargestOffset &&
        smoothed.offset_ticks < kLargestOffset)) {
    return bearings_of(sweep, smoothed);
  }
  constexpr int kAnglePlaces = 33, kTickPlaces = 16, kPeriodPlaces = 13;
  // 2 pi rad / revolution, so that ticks (2^-16) times it and 2^-30 are radians (2^-33).
  constexpr auto kWholeTurn = static_cast<std::int64_t>(kTwoPi * static_cast<double>(std::int64_t{1} << 60));
  static_assert(kAnglePlaces + 30 - kTickPlaces + kPeriodPlaces == 60);
  const auto rate = static_cast<fixed::Q30>(kWholeTurn / fixed::from_double(smoothed.period_ticks, kPeriodPlaces));
  const std::int64_t offset = fixed::from_double(smoothed.offset_ticks, kTickPlaces);
  SweepBearings bearings;
  for (const Hit& hit : sweep.hits) {
    const std::int64_t after_flash = std::int64_t{hit.centre_half_ticks} * (1 << (kTickPlaces - 1)) - offset;
    bearings.push_back({sweep.flash.start_ticks + hit.centre_half_ticks / 2,
                        fixed::to_double(fixed::times_wide(after_flash, rate), kAnglePlaces), hit.width_ticks,
                        hit.sensor});
  }
  return bearings;
}

}  // namespace pharos::lighthouse
