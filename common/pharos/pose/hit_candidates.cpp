// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/hit_candidates.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::pose {
namespace {

constexpr std::int8_t kNotInTarget = -1;
constexpr std::int8_t kNotYetSeen = -2;

}  // namespace

void HitCandidates::choose(int sensor, Axis axis, std::int16_t observation) {
  at(sensor, axis).chosen = observation;
  if (observation == kNone) {
    table.leave_out(sensor, axis);
  } else {
    const auto k = static_cast<std::size_t>(observation);
    table.see(sensor, axis, cosine[k], sine[k]);
  }
}

int HitCandidates::places() const {
  int number = 0;
  for (int a = 0; a < kAxes; ++a) {
    for (int i = 0; i < sensors(); ++i) number += at(i, static_cast<Axis>(a)).first != kNone ? 1 : 0;
  }
  return number;
}

bool collect_hit_candidates(const Target& target, const Observations& observations, HitCandidates& hits) {
  std::array<std::int8_t, kMaxSensors> placement_of, entry_of;
  placement_of.fill(kNotInTarget);
  entry_of.fill(kNotYetSeen);
  for (std::size_t k = 0; k < target.size(); ++k) {
    if (target[k].sensor < kMaxSensors) placement_of[target[k].sensor] = static_cast<std::int8_t>(k);
  }
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Observation& o = observations[k];
    if (!(o.theta_rad > 0.0 && o.theta_rad < kPi)) return false;
    if (o.sensor >= kMaxSensors || placement_of[o.sensor] == kNotInTarget) {
      hits.unknown_sensors = true;
      continue;
    }
    std::int8_t& entry = entry_of[o.sensor];
    if (entry == kNotYetSeen) {
      entry =
          static_cast<std::int8_t>(hits.table.add(target[static_cast<std::size_t>(placement_of[o.sensor])].position_m));
      for (auto& places : hits.place) places[static_cast<std::size_t>(entry)] = {};
    }
    hits.cosine[k] = std::cos(o.theta_rad);
    hits.sine[k] = std::sin(o.theta_rad);
    HitCandidates::Place& place = hits.at(entry, o.axis);
    hits.next[k] = place.first;
    hits.has_multiple = hits.has_multiple || place.first != HitCandidates::kNone;
    place.first = static_cast<std::int16_t>(k);
    hits.choose(entry, o.axis, place.first);
  }
  hits.table.pad();
  return true;
}

}  // namespace pharos::pose
