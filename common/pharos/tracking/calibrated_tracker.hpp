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

/// Without any station's flash for longer than this, a station may come back under another's number (decoders
/// extrapolate rotors for 300 s), so nothing that was known of a number holds any more.
inline constexpr std::int64_t kMaxDarkness_ticks = 240 * kTicksPerSecond;

/// Where a station's calibration comes from, and what becomes of a station that has none.
struct CalibrationPolicy {
  /// What stations send of themselves holds where the survey does not know them.
  bool use_sent = true;
  /// Sweeps of a station without calibration are answered as the ideal station's (track::kEpochUncalibrated), or not at
  /// all.
  bool answer_uncalibrated = true;
  /// What is known beforehand, and goes before what stations send; null: nothing. Must outlive the tracker.
  const StationSurvey* survey = nullptr;
};

/// Sweeps and OOTX payloads of one target in, answers out: a tracker that knows which station stands in which slot,
/// whose calibration holds there, and when to forget it.
///
/// - A calibration that a station sends holds from its second equal payload, or from the first that equals one accepted
///   before (lighthouse::CalibrationStore). One of the survey holds for its slot at once, for its id from the first
///   payload that names it: nothing of that payload but the id is used.
/// - The stations' relative pose holds while both slots' ids are known and the survey measured these two.
/// - After kMaxDarkness_ticks without a flash, and after restart(), it is unknown which station is which. What was
///   accepted is not forgotten: one payload brings it back.
///
/// Tracker: track::EpochTracker on the soft core, MethodTracker on a computer. Where it has no set_relative(), relative
/// poses are left out. Costs nothing beside the tracker's push() but a look at each sweep's flash; state: the
/// tracker's, and 1.1 KiB.
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

  /// What stations sent before: calibrations accepted, and who stands where, if that is known.
  void resume(const lighthouse::CalibrationStore& sent) {
    sent_ = sent;
    apply_calibrations();
  }
  /// The target's clock or its decoder began anew: numbers and times of before mean nothing any more.
  void restart() {
    sent_.forget_stations();
    newest_flash_ticks_ = kNoFlash;
    restart_tracking();
  }
  /// Sweeps may be missing from here on: the body is looked for anew. Stations stay who they are.
  void restart_tracking() {
    tracker_.forget_stations();
    apply_calibrations();
  }

  /// What is known of target or stations changed: the body is looked for anew, with a tracker of these arguments and
  /// what the policy's survey says now. Stations stay who they are.
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
  /// The tracker's answer, if this sweep brings one. A sweep of no station (number kMaxStations and above) is ignored.
  std::optional<track::EpochResult> push(const lighthouse::Sweep& sweep) {
    if (sweep.flash.station >= kMaxStations) return std::nullopt;
    watch_darkness(sweep.flash.start_ticks);
    if (!policy_.answer_uncalibrated && effective_calibration(sweep.flash.station) == nullptr) return std::nullopt;
    return tracker_.push(sweep);
  }
  /// End of the input: what is still held back (call until empty).
  std::optional<track::EpochResult> flush() { return tracker_.flush(); }

  /// The calibration that holds for a slot now; null for none.
  const lighthouse::StationCalibration* effective_calibration(std::uint8_t station) const {
    if (policy_.survey != nullptr) {
      if (const auto* known = policy_.survey->find(station, sent_.named_id(station))) return known;
    }
    return policy_.use_sent ? sent_.in_use(station) : nullptr;
  }
  /// What stations sent of themselves, used or not.
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

  // Every flash is light, also that of a station that is not answered. The first one ends no darkness.
  void watch_darkness(std::int64_t flash_ticks) {
    if (newest_flash_ticks_ != kNoFlash && flash_ticks - newest_flash_ticks_ > kMaxDarkness_ticks) restart();
    newest_flash_ticks_ = std::max(newest_flash_ticks_, flash_ticks);
  }
  // Setting again what a tracker has changes nothing there. Not inlined into each of its callers: the soft core's
  // image.
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
