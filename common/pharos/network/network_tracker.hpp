// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/network/network_filter.hpp"
#include "pharos/network/network_start.hpp"
#include "pharos/network/position_fix.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::network {

/// Why a result is as it is; bits of NetworkResult::flags.
enum NetworkFlag : std::uint8_t {
  kFused = 1,            // light of several stations within the last tenth of a second
  kOutliers = 2,         // hits of this sweep were left out
  kStationExcluded = 4,  // a station contradicts the others and is not used
};

struct NetworkOptions {
  HitNoise noise{40e-6, 40e-6, 0.2e-3, 0.3e-3, 0.6e-3};
  double max_rotation_rad = 1.0;  // stated sigmas beyond which no pose is reported
  double max_position_m = 0.1;
};

/// The body after a sweep.
struct NetworkResult {
  double time_s = 0.0;       // of the sweep's last hit
  std::uint8_t station = 0;  // whose sweep, its place among the stations
  std::uint8_t plane = 0;
  Result<WorldFromBody, pose::Refusal> pose = pose::Refusal::kNone;
  Matrix6 covariance = Matrix6::Zero();  // world frame, stations' uncertainty included
  double residual_rms_rad = 0.0;         // of this sweep's hits
  int observations = 0;                  // of this sweep that were used
  bool ambiguous = false;
  WorldFromBody second;  // where ambiguous
  double delta_chi2 = 0.0;
  std::uint8_t flags = 0;
};

struct NetworkCounters {
  std::uint64_t sweeps = 0, hits = 0, hits_left_out = 0, sweeps_refused = 0, starts = 0, losses = 0, exclusions = 0,
                strays = 0, readmissions = 0, rate_resets = 0, hits_unknown = 0;
};

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
  bool excluded(std::size_t station) const { return watch_[station].excluded; }

 private:
  static constexpr double kFresh_s = 0.1;  // light is of now

  struct StationWatch {
    bool excluded = false;
    bool disputed = false;  // contradicts the only other one that is heard, until its sweeps fit again
    int refused = 0;        // sweeps in a row beyond every model
    int accepted = 0;       // sweeps in a row that fit
    int dissents = 0;       // how often more than not it contradicted all others
    double seen_s = -1e9;
    std::array<double, kPlanes> plane_s = {-1e9, -1e9};  // of each plane's last sweep
    std::array<double, kPlanes> whole_s = {-1e9, -1e9};  // of its last one that hit every sensor
    std::array<Vector3, kPlanes> gradient;               // of its angle by the position then
    std::array<double, kPlanes> sigma_rad{};             // of what station and plane are wrong by
    // How far along its gradient each plane's last sweep puts the body, where it did not fit the filter, and when.
    std::array<Vector3, kPlanes> contradiction_m;
    std::array<double, kPlanes> contradicted_s = {-1e9, -1e9};
  };
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
  void forget_contradictions(const PositionFix& fix);
  double bearing_sigma(std::size_t station) const;  // of what station and plane are wrong by, rad
  void refuse(const LinearisedSweep& sweep);
  Matrix3 attitude_covariance(double off_rad) const;
  Matrix3 contradiction_covariance(double time_s) const;
  Matrix3 station_covariance(double time_s, const Vector3& body_m) const;
  bool take(const PlaneSweep& sweep, LinearisedSweep& linearised);
  bool fits(const LinearisedSweep& sweep) const;
  void watch(std::size_t station, bool fits, double time_s);
  bool disputed() const;
  void check_consensus(double time_s);
  double latest_s() const;
  bool try_start(double time_s);
  void start_at(const WorldFromBody& pose, double time_s);
  bool confirmed(double time_s) const;
  bool strayed(bool taken);
  bool shown_by_two_stations() const;
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
  std::array<StationWatch, kMaxNetworkStations> watch_;
  std::array<PlaneSweep, kMaxNetworkStations> open_;  // of each station: sweeps of several may overlap
  bool running_ = false;
  double time_s_ = 0.0;
  double accepted_s_ = 0.0;
  double checked_s_ = 0.0;
  double started_s_ = 0.0;
  double consensus_s_ = 0.0;
  std::optional<PositionFix> fix_;  // what two stations tell at once, now
  double asked_s_ = -1e9;           // when that was looked for
  double fixed_s_ = -1e9;           // when two stations last agreed with the filter
  double left_out_ = 0.0;           // fraction of the last sweeps' hits that did not fit the others of theirs
  double resets_ = 0.0;             // fraction of the last sweeps at which the rates were forgotten
  int refused_in_row_ = 0;
  int contradictions_ = 0;     // checks more than not in which no position fits all stations
  bool contradicted_ = false;  // from many contradictions until they are gone
  bool ambiguous_ = false;
  WorldFromBody second_;
  double delta_chi2_ = 0.0;
  NetworkCounters counters_;
};

}  // namespace pharos::network
