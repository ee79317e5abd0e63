// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/pose/observation.hpp"
#include "pharos/pose/observation_table.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::pose {

/// The observations of one cycle by sensor and axis: each place (sensor, axis) holds every hit that may be its true
/// one.
struct HitCandidates {
  static constexpr std::int16_t kNone = -1;
  struct Place {
    std::int16_t first = kNone;   // observation, then along next[]
    std::int16_t chosen = kNone;  // observation now in the table
  };

  ObservationTable table;  // rows of the chosen observations
  std::array<std::array<Place, kMaxSensors>, kAxes> place;
  std::array<std::int16_t, kMaxObservations> next;
  std::array<double, kMaxObservations> cosine, sine;  // of each observation
  bool has_multiple = false;                          // some place has more than one
  bool unknown_sensors = false;                       // some observation named a sensor that the target does not have

  Place& at(int sensor, Axis axis) {
    return place[static_cast<std::size_t>(index_of(axis))][static_cast<std::size_t>(sensor)];
  }
  const Place& at(int sensor, Axis axis) const {
    return place[static_cast<std::size_t>(index_of(axis))][static_cast<std::size_t>(sensor)];
  }
  /// Puts one hit of the place, or none, into the table.
  void choose(int sensor, Axis axis, std::int16_t observation);
  /// Places with at least one hit.
  int places() const;
  /// Sensors with a hit on either axis.
  int sensors() const { return table.count; }
};

/// Sorts observations into places; the first hit of each is chosen. False where a bearing is outside (0, pi) or not
/// finite.
bool collect_hit_candidates(const Target& target, const Observations& observations, HitCandidates& hits);

}  // namespace pharos::pose
