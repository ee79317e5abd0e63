// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/units.hpp"
#include "pharos/motion/contradictions.hpp"
#include "pharos/motion/station_pair.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::motion {

/// Stated sigmas (square roots of the traces) beyond which no pose is reported (too_uncertain). With the defaults the
/// body is as good as lost; a caller that needs every valid pose to be accurate sets smaller ones. Whatever the limits,
/// none is reported of coplanar sensors that may be tilted to the other side as well (Hypothesis::tilt_unknown).
struct UncertaintyLimits {
  double rotation_rad = 20.0 * kRadPerDeg;
  double position_m = 0.3;
};

struct MotionOptions {
  pose::SolveOptions solve;  // of the cycles solved alone; its sigma is the noise of one bearing, its rho that of ADOP
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  bool smooth_flashes = true;
  /// Fraction of a bearing's variance that rotor and flash add to all sensors of one sweep equally: 0.87 in the paper,
  /// 0.96 to 0.99 in recordings.
  double rho = kPaperRho;
  /// Known systematic errors of target and stations, for every result's covariance.
  SystematicErrors systematic;
  /// Of a station without calibration, which is taken for an ideal one.
  RotorSpread unknown_station = kFactorySpread;
  UncertaintyLimits limits;
};

/// The noise and station model of a tracker of single cycles; a rho of 0 there means not given, and becomes the paper's
/// here.
MotionOptions motion_options(const track::TrackOptions& same, const SystematicErrors& systematic,
                             const UncertaintyLimits& limits = {});

/// Consistency of the filter as the last sweep shows it.
struct InnovationStatistics {
  double nis = 0.0;  // chi-squared of its innovation
  int nis_degrees_of_freedom = 0;
  double residual_chi2 = 0.0;  // chi-squared of the residual that no pose explains
  int residual_degrees_of_freedom = 0;
};

/// Sweeps of one target in, a pose after every sweep out: motion-aware, each hit at its own instant. Up to two
/// stations; where both see the body, one filter takes the hits of both (StationPair).
///
/// One result a sweep that hit the target, in the frame of that sweep's station; its time is that of the last hit used.
/// Results have the form of EpochTracker's; `prior` then means that this station's recent sweeps do not suffice to
/// solve the pose alone, `fused` that the pose uses both stations. State and cost: README.md.
class MotionTracker {
 public:
  MotionTracker(const Target& target, const MotionOptions& options);
  /// `source`: what a station sent of itself leaves at least kUncalibratedErrors of its rotors.
  void set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration,
                       lighthouse::CalibrationSource source = lighthouse::CalibrationSource::kSurvey);
  /// None is known any more (another station stands there): what was known of this slot goes with it. Nothing changes
  /// where none was known.
  void clear_calibration(std::uint8_t station);
  /// Where slot 1's station stands, as measured; empty: learnt from what both stations see. Holds until another one is
  /// set, or forget_stations(); the same again changes nothing.
  void set_relative(const std::optional<StationRelative>& relative);
  /// The joint hypothesis and its present estimate of the relative pose.
  const StationPair& pair() const { return pair_; }
  /// As EpochTracker's.
  void forget_stations();
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep);
  /// As EpochTracker's; always empty.
  std::optional<track::EpochResult> flush() { return std::nullopt; }

  /// Pose, rates and covariance at any time from the present state: up to kLost_s ahead of the last hit (then empty, as
  /// where nothing is tracked); backwards the mean is moved and the covariance stays as it is now.
  std::optional<StateEstimate> predicted(std::uint8_t station, std::int64_t time_ticks) const;

  /// The bearings of the sweep last processed, hit by hit, those left out too.
  std::size_t bearing_count() const { return bearings_.size(); }
  track::TrackedBearing bearing(std::size_t index) const { return bearings_[index]; }
  const InnovationStatistics& innovation() const { return innovation_; }
  /// Sweeps left out since the start, because their flash came when the rotor cannot have turned.
  std::int64_t mistimed() const { return mistimed_; }

  /// After this long without a hit that fits, the body is lost and the track starts again.
  static constexpr double kLost_s = 0.5;

 private:
  struct Station {
    std::optional<lighthouse::StationCalibration> calibration;
    lighthouse::CalibrationSource source = lighthouse::CalibrationSource::kSurvey;
    std::array<RotorGate, kAxes> gate;
    std::array<lighthouse::FlashSmoother, kAxes> smoother;
    track::CycleAssembler assembler;
    StationTrack track;
  };

  StationView view_of(const Station& station) const;
  AssumedNoise noise_of(const Station& station) const;
  StationPair::Tracks tracks() const { return {&stations_[0].track, &stations_[1].track}; }
  void assess(const Station& station);
  const Hypothesis* better_of(const Station& station, std::uint8_t slot, std::int64_t time_ticks) const;
  track::EpochResult answer(Station& station, const lighthouse::Sweep& sweep,
                            const lighthouse::SweepBearings& bearings);
  Result<LighthousePoseEstimate, pose::Refusal> estimate(const Station& station, const Hypothesis& best,
                                                         const lighthouse::SweepBearings& bearings,
                                                         track::EpochResult& result) const;
  bool trusted(const Station& station, const Hypothesis& best) const;
  std::optional<track::EpochResult> refused_as_mistimed(const lighthouse::Sweep& sweep);
  void keep_bearings(const lighthouse::SweepBearings& bearings, Axis axis, const SweepFit* fit);

  Target target_;
  MotionOptions options_;
  std::array<Station, kMaxStations> stations_;
  StationPair pair_;
  // The sweep last answered.
  StaticVector<track::TrackedBearing, kMaxHitsPerSweep> bearings_;
  InnovationStatistics innovation_;
  Contradictions contradictions_;
  std::int64_t mistimed_ = 0;
};

}  // namespace pharos::motion
