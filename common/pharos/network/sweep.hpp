// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/network/station.hpp"

namespace pharos::network {

/// A hit of one sensor: when its light came, and the raw angle.
struct Hit {
  double time_s = 0.0;
  std::uint8_t sensor = 0;
  double angle_rad = 0.0;
};

/// All hits of one pass of one laser plane over the target.
struct PlaneSweep {
  std::size_t station = 0;  // its place among the stations
  std::size_t plane = 0;
  StaticVector<Hit, kMaxHitsPerSweep> hits;

  double time_s() const {  // of the last hit
    double last_s = hits.empty() ? 0.0 : hits[0].time_s;
    for (const Hit& hit : hits) last_s = hit.time_s > last_s ? hit.time_s : last_s;
    return last_s;
  }
};

/// What a station is held to be wrong by where its file states no sigmas: a geometry found once from a target on the
/// floor, as peers do, leaves each station turned about the world's origin by 0.5 to 2 deg and at a range that is wrong
/// by 1 % (measured against motion capture), hence 15 to 30 mm at 1 m from the origin and 80 mm at 3 m.
inline constexpr StationSigmas kUnstatedSigmas{0.05, 0.0, 0.0015, 0.009, 0.006, {}};

/// Noise of the hits of one sweep, 1 sigma.
struct HitNoise {
  double own_rad = 0.0;     // of each hit alone
  double common_rad = 0.0;  // of rotor and sync: the same for all
  double sensor_m = 0.0;    // of each sensor's position: own noise of sensor_m / range
  double time_s = 0.0;      // of the sweep's time: what the body moves meanwhile is common noise
  // What a plane's model leaves at the edge of its field, where a calibration tells little of it: beside what stations
  // may contradict each other by on the whole. Without it a geometry of Lighthouse 2.0 that is right to 0.3 mrad left a
  // third of another recording's epochs without an answer.
  double model_rad = 0.0;
  StationSigmas unstated = kUnstatedSigmas;
};

}  // namespace pharos::network
