// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/calibrate/sweep_log.hpp"

namespace pharos::calibrate {

/// A time in which the target did not move.
struct StationaryInterval {
  std::int64_t from_ticks = 0;
  std::int64_t to_ticks = 0;  // first tick after it
  bool holds(std::int64_t ticks) const { return ticks >= from_ticks && ticks < to_ticks; }
};

/// Stationary intervals of a recording, and those that were discarded.
struct StationarySearch {
  std::vector<StationaryInterval> intervals;
  std::size_t too_short = 0;  // intervals below half a second
  std::size_t drifting = 0;   // stationary from block to block, but drifting over the interval
};

/// Finds the intervals of half a second or more in which the target did not move.
///
/// Sweeps are grouped into blocks of 0.1 s. A block belongs to the interval before it while its mean angles agree with
/// those of the interval, channel by channel (station, rotor, sensor), within five sigmas of the noisiest real
/// recording (11 arcsec a sweep); four fifths of the channels, at least six, must agree, so that one reflection or hand
/// does not end an interval. The first and last block of an interval are discarded: motion may have begun in them. An
/// interval whose first and last third differ is drifting and discarded. At 2 m a motion of 0.3 mm/s is detected.
StationarySearch find_stationary_intervals(std::span<const LoggedSweep> sweeps);

}  // namespace pharos::calibrate
