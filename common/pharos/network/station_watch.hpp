// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "pharos/network/last_time.hpp"
#include "pharos/network/network_result.hpp"
#include "pharos/network/station_consensus.hpp"

namespace pharos::network {

/// Light of the last tenth of a second is of now.
inline constexpr double kFresh_s = 0.1;

using StationMask = std::array<bool, kMaxNetworkStations>;

/// Which stations are used: a station that contradicts the others was moved, or its entry in the file is wrong.
class StationWatch {
 public:
  /// A sweep of it fits the filter or not.
  void watch(std::size_t station, bool fits, double time_s, NetworkCounters& counters);
  /// One check of whether a position fits them all.
  void take(const Consensus& consensus, NetworkCounters& counters);
  /// The body is found anew: what fitted before says nothing.
  void begin();

  bool excluded(std::size_t station) const { return excluded_[station]; }
  bool any_excluded() const { return std::find(excluded_.begin(), excluded_.end(), true) != excluded_.end(); }
  const StationMask& excluded() const { return excluded_; }
  /// One contradicts the only other one that is heard, until its sweeps fit again.
  bool disputed() const;
  /// No position fits all stations: now and then, or so often that nothing is answered.
  bool has_contradictions() const { return contradictions_ > 0; }
  bool too_contradictory() const { return too_contradictory_; }
  /// Stations in use whose light fitted of late.
  int fresh(double time_s) const;

 private:
  struct Record {
    bool disputed = false;
    int refused = 0;   // sweeps in a row beyond every model
    int accepted = 0;  // sweeps in a row that fit
    int dissents = 0;  // how often more than not it contradicted all others
    LastTime seen;
  };

  std::array<Record, kMaxNetworkStations> records_;
  StationMask excluded_{};
  int contradictions_ = 0;          // checks more than not in which no position fits all stations
  bool too_contradictory_ = false;  // from many contradictions until they are gone
};

}  // namespace pharos::network
