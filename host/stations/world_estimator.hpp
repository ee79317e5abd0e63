// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>

#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/network/network_tracker.hpp"

namespace pharos::host {

/// Sweeps of the Lighthouse 2.0 stations of a room to poses of the body in the world.
///
/// Sweeps come complete, up to some milliseconds after another station's: their hits are put in the order of time,
/// which delays poses by 4 ms.
class WorldEstimator {
 public:
  WorldEstimator(const network::Stations& stations, const Target& target);

  void push(const lighthouse::Lh2Sweep& sweep);
  /// The end of the input: what is held back.
  void flush();
  /// The target's clock started anew.
  void restart();
  /// The next result in the order of time.
  std::optional<network::NetworkResult> next();

  const network::NetworkCounters& counters() const { return tracker_->counters(); }
  /// Hits that came after later ones had been used.
  std::int64_t hits_late() const { return hits_late_; }
  const network::Stations& stations() const { return stations_; }

 private:
  struct PlacedHit {
    network::Hit hit;
    std::uint8_t station = 0;
    std::uint8_t plane = 0;
    bool operator<(const PlacedHit& other) const { return hit.time_s < other.hit.time_s; }
  };

  void use_until(double time_s);

  network::Stations stations_;
  Target target_;
  std::unique_ptr<network::NetworkTracker> tracker_;
  std::multiset<PlacedHit> waiting_;
  std::deque<network::NetworkResult> results_;
  double newest_s_ = 0.0;
  double used_s_ = 0.0;
  bool any_ = false;
  std::int64_t hits_late_ = 0;
};

}  // namespace pharos::host
