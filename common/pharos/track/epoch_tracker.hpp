// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/flash_smoother.hpp"
#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/pose/solve.hpp"
#include "pharos/track/cycle.hpp"
#include "pharos/track/ideal_observations.hpp"

namespace pharos::track {

struct TrackOptions {
  pose::SolveOptions solve;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  bool smooth_flashes = true;
  /// With three sensors only, the last pose of the same station serves as prior when it is younger than this: at 2 m/s
  /// and 180 deg/s a target moves 0.2 m and 18 deg in it. 0 = never.
  double prior_max_age_s = 0.1;
  /// For cores without a floating-point unit: start every cycle from the last pose, and compute in integers where the
  /// result is the same (pose::solve_warm).
  bool warm_start = false;
  /// Maximum age of such a start pose: where it is too far off, the integer solver fails. Solving two stations' first
  /// poses from nothing takes a soft core of 50 MHz 0.4 s.
  double warm_max_age_s = 1.0;
  /// Cycles that the integer solver refuses go through the search in double (solve.max_search_starts). After one
  /// without result the station's next ones are refused for this long (kSearchLimit), or a bad view would take all of a
  /// slow core's time.
  std::int64_t search_cooldown_ticks = 0;
};

/// Words said about one cycle's answer; a bit set.
enum EpochFlag : std::uint8_t {
  kEpochUncalibrated = 1,   // no calibration of this station was known: angles of an ideal station
  kEpochFlashWeak = 2,      // as in Sweep
  kEpochPeriodNominal = 4,  // as in Sweep
  kEpochOutliers = 8,       // hits were left out (reflections, or they fit no rigid body)
  kEpochPrior = 16,         // could only be solved with the last pose as prior
  kEpochLockPoor = 32,      // as in Sweep
  kEpochResidualHigh = 64,  // the residual is beyond what the assumed noise explains: stated sigmas are too small
  kEpochFused = 128,        // uses both stations' hits (motion)
};
inline constexpr std::array<FlagWord, 8> kEpochFlagWords{{
    {kEpochUncalibrated, "uncalibrated"},
    {kEpochFlashWeak, "flash_weak"},
    {kEpochPeriodNominal, "period_nominal"},
    {kEpochOutliers, "outliers"},
    {kEpochPrior, "prior"},
    {kEpochLockPoor, "lock_poor"},
    {kEpochResidualHigh, "residual_high"},
    {kEpochFused, "fused"},
}};

/// Result of one cycle of one station (its x and its y sweep): a pose, or why there is none.
struct EpochResult {
  std::uint8_t station = 0;
  std::uint8_t flags = 0;       // of EpochFlag
  std::int64_t time_ticks = 0;  // mean time of the hits used (of all hits where refused)
  int observations = 0;         // angles used; offered where refused
  Result<LighthousePoseEstimate, pose::Refusal> pose = pose::Refusal::kTooFewSensors;
};

/// One bearing of the cycle last solved, with its residual.
struct TrackedBearing {
  lighthouse::Bearing raw;  // from the rotor, uncorrected
  Axis axis = Axis::kX;
  double ideal_theta_rad = 0.0;  // with the station's errors removed
  bool used = false;
  double residual_rad = 0.0;  // ideal minus predicted; 0 where there is no pose or the target has no such sensor
};

/// Sweeps of one target in, one result a station and cycle out: each cycle is solved alone, as in paper 002 (section
/// 2.3), as if all its hits were simultaneous. Up to two stations in parallel, each in its own frame.
///
/// Holds about 14 KiB. One push costs at most one solve (two where a sensor was hit on one axis only or twice).
class EpochTracker {
 public:
  EpochTracker(const Target& target, const TrackOptions& options);
  /// Calibration of the station in this slot position, from now on.
  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration);
  /// None is known any more (another station stands there): what was known of this slot goes with it. Nothing changes
  /// where none was known.
  void clear_calibration(std::uint8_t station);
  /// Everything known of the stations: calibrations, flashes, last poses, cycles not complete.
  void forget_stations();
  /// The result of the cycle that this sweep completed, if any: the y sweep completes its cycle at once; a cycle
  /// without y sweep is solved with the station's next sweep. A skipped sweep only updates the smoother.
  std::optional<EpochResult> push(const lighthouse::Sweep& sweep);
  /// End of the input: the result of the cycle still held back, if any (call until empty).
  std::optional<EpochResult> flush();
  /// The bearings of the cycle last solved, hit by hit, refused ones too.
  std::size_t bearing_count() const { return ideal_.observations.size(); }
  TrackedBearing bearing(std::size_t index) const;

 private:
  struct Station {
    std::optional<lighthouse::StationCalibration> calibration;
    std::array<lighthouse::FlashSmoother, kAxes> smoother;
    CycleAssembler assembler;
    std::optional<LighthouseFromBody> last_pose;
    std::int64_t last_pose_ticks = 0;
    std::int64_t search_cooldown_until_ticks = 0;  // no search before
  };

  using SolveResult = Result<pose::Solution, pose::Refusal>;

  /// Adds the sweep to its cycle; returns the cycle if that completed it.
  const Cycle* take(Station& station, const lighthouse::Sweep& sweep, const lighthouse::SmoothedFlash& smoothed,
                    bool may_complete);
  /// The result of the cycle that this sweep completes or closes.
  std::optional<EpochResult> complete(Station& station, const lighthouse::Sweep& sweep,
                                      const lighthouse::SmoothedFlash& smoothed);
  void answer(Station& station, const Cycle& cycle, EpochResult& result);
  void accept(Station& station, const Cycle& cycle, const pose::Solution& solution, EpochResult& result);
  void refuse(const Cycle& cycle, pose::Refusal why, EpochResult& result) const;
  void correct(const Station& station, const Cycle& cycle, const LighthouseFromBody* pose);
  void solve(Station& station, const Cycle& cycle, EpochResult& result, SolveResult& answer);
  void solve_from(const LighthouseFromBody* prior, Station& station, const Cycle& cycle, SolveResult& answer) const;
  bool solve_warm_from(const LighthouseFromBody& prior, SolveResult& answer) const;
  int sensors_seen() const;
  static const LighthouseFromBody* fresh_pose(const Station& station, const Cycle& cycle, double max_age_s);

  Target target_;
  TrackOptions options_;
  std::array<Station, kMaxStations> stations_;
  // The cycle last answered.
  IdealObservations ideal_;
  std::bitset<pose::kMaxObservations> used_;
  std::optional<LighthouseFromBody> solved_pose_;
};

}  // namespace pharos::track
