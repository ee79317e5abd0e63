// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/calibrate/sweep_log.hpp"

namespace pharos::calibrate {

/// A time in which the target rested.
struct StationaryInterval {
  std::int64_t from_ticks = 0;
  std::int64_t to_ticks = 0;  // first tick behind it
  bool holds(std::int64_t ticks) const { return ticks >= from_ticks && ticks < to_ticks; }
};

/// What a recording shows of rest and motion.
struct StationarySearch {
  std::vector<StationaryInterval> intervals;
  std::size_t too_short = 0;  // rests below half a second
  std::size_t drifting = 0;   // looked still from moment to moment, but crept
};

/// Finds where the target rested for half a second or more.
///
/// Sweeps are gathered to blocks of 0.1 s. A block belongs to the rest before it while its mean angles agree with that
/// rest's, channel by channel (station, rotor, sensor), within five sigmas of the noisiest real recording (11 arcsec a
/// sweep); four fifths of the channels, at least six, must agree, so that one reflection or hand does not end a rest.
/// The first and last block of a rest are given up: motion may have begun in them. A rest whose first and last third
/// differ is creeping and dropped. At 2 m a motion of 0.3 mm/s is found.
StationarySearch find_stationary_intervals(std::span<const LoggedSweep> sweeps);

}  // namespace pharos::calibrate
