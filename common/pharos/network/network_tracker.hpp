// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/network/network_filter.hpp"
#include "pharos/network/network_result.hpp"
#include "pharos/network/network_start.hpp"
#include "pharos/network/position_fix.hpp"
#include "pharos/network/seen_planes.hpp"
#include "pharos/network/station_watch.hpp"

namespace pharos::network {

/// A target among 1 to 16 stations of known poses, LH1 or LH2: each sweep at its own instant in one motion model,
/// stations that contradict the others left out; while two contradict each other nothing is answered.
///
/// Fixed size; 160 kB. push() takes hits in the order of time, gathers them to sweeps and gives the result of the
/// sweep before when a new one begins.
class NetworkTracker {
 public:
  /// All stations need a pose; `stations` and `target` are kept by value.
  NetworkTracker(const Stations& stations, const Target& target, const NetworkOptions& options);

  /// `station`: its number; hits of unknown ones are counted and left out.
  std::optional<NetworkResult> push(std::uint8_t station, std::size_t plane, const Hit& hit);
  /// The end: a sweep still open, the oldest first; empty when none is.
  std::optional<NetworkResult> flush();

  const NetworkCounters& counters() const { return counters_; }
  /// What is held of the stations now.
  const NetworkState& state() const { return filter_.mean(); }
  bool excluded(std::size_t station) const { return watch_.excluded(station); }

 private:
  static constexpr double kCheckAmbiguous_s = 0.03;  // between looks for other poses while there may be one
  struct Choice {
    WorldFromBody pose;
    double cost = 1e300;
    double second_cost = 1e300;
    WorldFromBody second;
  };

  PlaneSweep* oldest_open(double before_s);
  std::optional<NetworkResult> close(PlaneSweep* open);
  NetworkResult process(const PlaneSweep& sweep);
  NetworkResult refused(const PlaneSweep& sweep, pose::Refusal why) const;
  NetworkResult result(const LinearisedSweep& sweep);
  NetworkResult from_fix(const PlaneSweep& sweep, double doubt_rad) const;
  void saw(const LinearisedSweep& sweep);
  void saw(const PositionFix& fix);
  double bearing_sigma(std::size_t station) const;  // of what station and plane are wrong by, rad
  Matrix3 attitude_covariance(double off_rad) const;
  Matrix3 station_covariance(double time_s, const Vector3& body_m) const;
  bool take(const PlaneSweep& sweep, LinearisedSweep& linearised);
  bool fits(const LinearisedSweep& sweep) const;
  bool disputed() const;
  void check_consensus(double time_s);
  double latest_s() const;
  bool try_start(double time_s);
  void start_at(const WorldFromBody& pose, double time_s);
  bool confirmed(double time_s) const;
  bool strayed(bool taken);
  bool fix_is_better() const;
  bool attitude_suspect() const;
  bool attitude_doubted() const;
  double attitude_doubt_rad() const;
  bool check_attitude();
  double position_variance() const;  // of the filter, m^2: the sum of three
  double apart_chi2(const PositionFix& fix, bool but_one) const;
  SweepView used_recent() const;
  SweepView all_recent() const;
  Choice best_start(const Starts& starts);
  double cost_of(const WorldFromBody& start, WorldFromBody& refined);
  void check_alternatives(double time_s, bool doubted);

  Stations stations_;
  Target target_;
  NetworkOptions options_;
  Matrix3 placement_covariance_;  // of the attitude, body frame
  NetworkFilter filter_;
  NetworkFilter trial_;
  RecentSweeps recent_;
  StationWatch watch_;
  SeenPlanes planes_;
  std::array<PlaneSweep, kMaxNetworkStations> open_;  // of each station: sweeps of several may overlap
  bool running_ = false;
  double time_s_ = 0.0;
  double accepted_s_ = 0.0;
  double checked_s_ = 0.0;
  double started_s_ = 0.0;
  double consensus_s_ = 0.0;
  std::optional<PositionFix> fix_;  // what two stations tell at once, now
  LastTime asked_;                  // when that was looked for
  LastTime fixed_;                  // when two stations last agreed with the filter
  double left_out_ = 0.0;           // fraction of the last sweeps' hits that did not fit the others of theirs
  double resets_ = 0.0;             // fraction of the last sweeps at which the rates were forgotten
  int refused_in_row_ = 0;
  bool ambiguous_ = false;
  WorldFromBody second_;
  double delta_chi2_ = 0.0;
  NetworkCounters counters_;
};

}  // namespace pharos::network
