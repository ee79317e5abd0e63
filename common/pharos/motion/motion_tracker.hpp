// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/units.hpp"
#include "pharos/motion/station_pair.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::motion {

/// Stated sigmas (square roots of the traces) beyond which an answer is none (too_uncertain). As they stand: a body
/// seen so badly is as good as lost. Who needs every valid pose to be good sets what good is.
struct UncertaintyLimits {
  double rotation_rad = 20.0 * kRadPerDeg;
  double position_m = 0.3;
};

struct MotionOptions {
  pose::SolveOptions solve;  // of the cycles solved alone; its sigma is the noise of one bearing, its rho that of ADOP
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  bool smooth_flashes = true;
  /// Fraction of a bearing's variance that rotor and flash give to all sensors of one sweep alike: 0.87 in the paper,
  /// 0.96 to 0.99 in recordings.
  double rho = kPaperRho;
  /// What is known to be wrong with target and stations, for every answer's covariance.
  SystematicErrors systematic;
  UncertaintyLimits limits;
};

/// The noise and station model of a tracker of single cycles; a rho of 0 there was not told, and is the paper's here.
MotionOptions motion_options(const track::TrackOptions& same, const SystematicErrors& systematic,
                             const UncertaintyLimits& limits = {});

/// What the last sweep said of the tracker's own honesty.
struct InnovationStatistics {
  double nis = 0.0;  // chi-squared of what it said to the prediction
  int nis_degrees_of_freedom = 0;
  double residual_chi2 = 0.0;  // chi-squared of what no pose explains
  int residual_degrees_of_freedom = 0;
};

/// Sweeps of one target in, a pose after every sweep out: motion-aware, each hit taken at its own instant. Up to two
/// stations; where both see the body, one belief takes the hits of both (StationPair).
///
/// One answer a sweep that hit the target, in the frame of that sweep's station; its time is that of the last hit used.
/// Answers have the form of EpochTracker's; `prior` then means that this station saw the body too little of late to
/// solve it alone, `fused` that the pose rests on both stations. State: some 100 KiB. Cost: README.
class MotionTracker {
 public:
  MotionTracker(const Target& target, const MotionOptions& options);
  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration);
  /// None is known any more (another station stands there): what was known of this slot goes with it. Nothing changes
  /// where none was known.
  void clear_calibration(std::uint8_t station);
  /// Where slot 1's station stands, as measured; empty: learnt from what both stations see. Holds until another one is
  /// set, or forget_stations(); the same again changes nothing.
  void set_relative(const std::optional<StationRelative>& relative);
  /// What became of it, and what is known now.
  const StationPair& pair() const { return pair_; }
  /// As EpochTracker's.
  void forget_stations();
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep);
  /// As EpochTracker's; nothing is ever held back.
  std::optional<track::EpochResult> flush() { return std::nullopt; }

  /// Pose, rates and covariance at any time from what is known now: up to kLost_s ahead of the last hit (then empty, as
  /// where nothing is tracked); backwards the mean is moved and the covariance stays that of now.
  std::optional<StateEstimate> predicted(std::uint8_t station, std::int64_t time_ticks) const;

  /// The bearings of the sweep last answered, hit by hit, those left out too.
  std::size_t bearing_count() const { return bearings_.size(); }
  track::TrackedBearing bearing(std::size_t index) const { return bearings_[index]; }
  const InnovationStatistics& innovation() const { return innovation_; }

  /// After this long without a hit that fits, the body is lost and looked for anew.
  static constexpr double kLost_s = 0.5;

 private:
  struct Station {
    std::optional<lighthouse::StationCalibration> calibration;
    std::array<lighthouse::FlashSmoother, kAxes> smoother;
    track::CycleAssembler assembler;
    StationTrack track;
  };

  StationView view_of(const Station& station) const;
  AssumedNoise noise() const { return {options_.solve.sigma_rad, options_.rho, options_.systematic}; }
  StationPair::Tracks tracks() const { return {&stations_[0].track, &stations_[1].track}; }
  const Hypothesis* better_of(const Station& station, std::uint8_t slot, std::int64_t time_ticks) const;
  track::EpochResult answer(Station& station, const lighthouse::Sweep& sweep,
                            const lighthouse::SweepBearings& bearings);
  Result<LighthousePoseEstimate, pose::Refusal> estimate(const Station& station, const Hypothesis& best,
                                                         const lighthouse::SweepBearings& bearings,
                                                         track::EpochResult& result) const;
  void keep_bearings(const lighthouse::SweepBearings& bearings, Axis axis, const SweepFit* fit);

  Target target_;
  MotionOptions options_;
  std::array<Station, kMaxStations> stations_;
  StationPair pair_;
  // The sweep last answered.
  StaticVector<track::TrackedBearing, kMaxHitsPerSweep> bearings_;
  InnovationStatistics innovation_;
};

}  // namespace pharos::motion
