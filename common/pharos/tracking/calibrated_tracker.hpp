// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "pharos/base/capacity.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::tracking {

/// Maximum time without a flash of any station. After a longer time a station may come back with another slot number
/// (decoders extrapolate rotors for 300 s), so that everything known about slot numbers becomes invalid.
inline constexpr std::int64_t kMaxDarkness_ticks = 240 * kTicksPerSecond;

/// Source of the stations' calibrations, and handling of a station without one.
struct CalibrationPolicy {
  /// Use calibrations that stations send, for stations that are not in the survey.
  bool use_sent = true;
  /// Sweeps of a station without calibration are used as those of an ideal station (track::kEpochUncalibrated), or
  /// ignored.
  bool answer_uncalibrated = true;
  /// Known calibrations, which take precedence over those that stations send; null: none. Must outlive the tracker.
  const StationSurvey* survey = nullptr;
};

/// Computes results from sweeps and OOTX payloads of one target: a tracker that also manages which station is in which
/// slot, which calibration is in effect there, and when it becomes invalid.
///
/// - A calibration that a station sends is used from its second equal payload on, or from the first one that equals a
///   previously accepted one (lighthouse::CalibrationStore). A calibration of the survey by slot is used at once; one
///   by id from the first payload with that id on, of which nothing but the id is used.
/// - The stations' relative pose is used while the ids of both slots are known and the survey has this pair.
/// - After kMaxDarkness_ticks without a flash, and after restart(), the stations of the slots are unknown. Accepted
///   calibrations are kept: one payload puts them into effect again.
///
/// Tracker: track::EpochTracker on the soft core, MethodTracker on a computer. Relative poses are not used if it has no
/// set_relative(). The cost in addition to the tracker's push() is one comparison per sweep; state: the tracker's, and
/// 1.1 KiB.
template <class Tracker>
class CalibratedTracker {
 public:
  template <class... Arguments>
  explicit CalibratedTracker(const CalibrationPolicy& policy, Arguments&&... tracker)
      : policy_(policy), tracker_(std::forward<Arguments>(tracker)...) {
    apply_calibrations();
  }
  CalibratedTracker(const CalibratedTracker&) = delete;
  CalibratedTracker& operator=(const CalibratedTracker&) = delete;

  /// Restores the data that stations sent earlier: accepted calibrations, and the stations of the slots if known.
  void resume(const lighthouse::CalibrationStore& sent) {
    sent_ = sent;
    apply_calibrations();
  }
  /// The target's clock or its decoder restarted: earlier slot numbers and times are invalid.
  void restart() {
    sent_.forget_stations();
    newest_flash_ticks_ = kNoFlash;
    restart_tracking();
  }
  /// Restarts tracking because sweeps may be missing. The stations of the slots stay known.
  void restart_tracking() {
    tracker_.forget_stations();
    apply_calibrations();
  }

  /// Restarts tracking after a change of the target or the survey, with a new tracker of these arguments and the
  /// policy's current survey. The stations of the slots stay known.
  template <class... Arguments>
  void rebuild(Arguments&&... tracker) {
    tracker_ = Tracker(std::forward<Arguments>(tracker)...);
    apply_calibrations();
  }

  lighthouse::CalibrationStore::Verdict push(const lighthouse::OotxPayload& payload) {
    const auto verdict = sent_.push(payload);
    apply_calibrations();
    return verdict;
  }
  /// The tracker's result, if this sweep gives one. A sweep of an invalid station (number >= kMaxStations) is ignored.
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep) {
    if (sweep.flash.station >= kMaxStations) return std::nullopt;
    watch_darkness(sweep.flash.start_ticks);
    if (!policy_.answer_uncalibrated && effective_calibration(sweep.flash.station) == nullptr) return std::nullopt;
    return tracker_.push(sweep);
  }
  /// End of the input: a result that was still held back (call until empty).
  std::optional<track::EpochResult> flush() { return tracker_.flush(); }

  /// The calibration in effect for a slot; null for none.
  const lighthouse::StationCalibration* effective_calibration(std::uint8_t station) const {
    if (policy_.survey != nullptr) {
      if (const auto* known = policy_.survey->find(station, sent_.named_id(station))) return known;
    }
    return policy_.use_sent ? sent_.in_use(station) : nullptr;
  }
  /// The calibrations that stations sent, used or not.
  const lighthouse::CalibrationStore& sent() const { return sent_; }
  const Tracker& tracker() const { return tracker_; }

 private:
  static constexpr bool kTakesRelative = requires(Tracker & tracker, const StationSurvey& survey) {
    tracker.set_relative(survey.relative(0, 0));
  };
  static constexpr bool kTakesSource = requires(Tracker & tracker, const lighthouse::StationCalibration& calibration) {
    tracker.set_calibration(0, calibration, lighthouse::CalibrationSource::kSent);
  };
  static constexpr std::int64_t kNoFlash = std::numeric_limits<std::int64_t>::min();

  // Every flash ends a dark interval, also that of an ignored station. Before the first flash there is no dark
  // interval.
  void watch_darkness(std::int64_t flash_ticks) {
    if (newest_flash_ticks_ != kNoFlash && flash_ticks - newest_flash_ticks_ > kMaxDarkness_ticks) restart();
    newest_flash_ticks_ = std::max(newest_flash_ticks_, flash_ticks);
  }
  // Setting a calibration that the tracker already has changes nothing. Not inlined into its callers, for the size of
  // the soft core's image.
  [[gnu::noinline]] void apply_calibrations() {
    for (std::uint8_t station = 0; station < kMaxStations; ++station) {
      if (const auto* calibration = effective_calibration(station)) {
        give(station, *calibration);
      } else {
        tracker_.clear_calibration(station);
      }
    }
    if constexpr (kTakesRelative) {
      if (policy_.survey != nullptr) {
        tracker_.set_relative(policy_.survey->relative(sent_.named_id(0), sent_.named_id(1)));
      }
    }
  }

  void give(std::uint8_t station, const lighthouse::StationCalibration& calibration) {
    if constexpr (kTakesSource) {
      const bool sent = &calibration == sent_.in_use(station);
      tracker_.set_calibration(station, calibration,
                               sent ? lighthouse::CalibrationSource::kSent : lighthouse::CalibrationSource::kSurvey);
    } else {
      tracker_.set_calibration(station, calibration);
    }
  }

  CalibrationPolicy policy_;
  lighthouse::CalibrationStore sent_;
  Tracker tracker_;
  std::int64_t newest_flash_ticks_ = kNoFlash;
};

}  // namespace pharos::tracking
