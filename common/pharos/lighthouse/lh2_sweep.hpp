// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/lighthouse/lh2_channels.hpp"

namespace pharos::lighthouse {

/// One pass of a laser plane over one sensor.
struct Lh2Hit {
  std::uint8_t sensor = 0;
  std::uint16_t width_ticks = 0;
  /// Middle of the light after the sync by the station's own clock, 1/6 tick: bits of its sequence x 50.
  std::int32_t centre_sixths = 0;

  bool operator==(const Lh2Hit&) const = default;
};

/// All hits of one pass of one laser plane over the target. Integers only: the same bits on the target, on the wire and
/// on the host. A sensor may have several hits (reflections): all are kept.
struct Lh2Sweep {
  std::int64_t sync_sixths = 0;  // by our clock, 1/6 tick of 20 ns; of this turn of the rotor
  std::uint8_t channel = 0;      // 0..15
  std::uint8_t plane = 0;        // 0 = a, the first after the sync; 1 = b
  bool slow_bit = false;         // the turn's bit of OOTX
  StaticVector<Lh2Hit, kMaxHitsPerSweep> hits;
};

/// The plane that stands over its field of view at `place` bits after the sync: a in the first half of the turn, b in
/// the second (their fields of view, 120 deg around 1/3 and 2/3 of a turn, meet there).
constexpr std::uint8_t lh2_plane_of(std::int64_t centre_sixths, std::size_t channel) {
  return 2 * centre_sixths < lh2_turn_sixths(channel) ? std::uint8_t{0} : std::uint8_t{1};
}

/// Raw angle of lh2_model.hpp: the rotor since its sync, at the nominal period, less 2/3 pi (a) or 4/3 pi (b).
constexpr double lh2_hit_angle(const Lh2Sweep& sweep, const Lh2Hit& hit) {
  const double turned_rad = kTwoPi * hit.centre_sixths / static_cast<double>(lh2_turn_sixths(sweep.channel));
  return turned_rad - (sweep.plane == 0 ? kTwoPi / 3 : 2 * kTwoPi / 3);
}

/// When the middle of the light came, s of our clock. The station's clock departs from ours by some 10 ppm: 0.2 us.
constexpr double lh2_hit_time(const Lh2Sweep& sweep, const Lh2Hit& hit) {
  return static_cast<double>(sweep.sync_sixths + hit.centre_sixths) * (kSecondsPerTick / kSixthsPerTick);
}

}  // namespace pharos::lighthouse
