// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {

/// What became of a measurement.
struct Outcome {
  Refusal refusal = Refusal::kNone;
  Use use = Use::kSearching;  // where it was not refused
  bool late = false;          // it came after a later one: the state was computed again from before it
};

/// One state of the target from the poses of all sources.
///
/// Measurements of different sources may arrive in any order within kMinLag_s: the result is, bit by bit, that of the
/// order of their times. Those of one source must arrive in order. No clock is read: time is that of the measurements.
///
/// State: sizeof(TargetEstimator), at most 256 KiB; no heap. Cost: README.md.
class TargetEstimator {
 public:
  /// Measurements at least this late are used; more than twice as late ones are refused.
  static constexpr double kMinLag_s = 0.2;

  /// `settings` pass check_settings.
  explicit TargetEstimator(const Settings& settings);
  TargetEstimator(const TargetEstimator&) = delete;
  TargetEstimator& operator=(const TargetEstimator&) = delete;

  Outcome push(const Measurement& measurement);
  /// Sets a source's bias covariance before its first measurement: what a mounting leaves depends on where the target
  /// is. False, and nothing changed, where the source was heard or the matrix is not positive definite.
  bool set_bias_covariance(std::uint8_t source, const Matrix6& covariance);
  /// Predicted to `time_ns` with the covariance of the prediction.
  TargetState state(std::int64_t time_ns) const { return core_.report(current_, time_ns); }
  /// Time of the newest measurement that was used or gated; 0 before the first.
  std::int64_t newest_ns() const { return started_ ? current_.time_ns : 0; }
  const FusionCounters& counters() const { return current_.counters; }
  std::uint64_t refused(Refusal reason) const { return refused_[static_cast<std::size_t>(reason)]; }
  std::uint64_t late() const { return late_; }
  const Settings& settings() const { return settings_; }
  /// Forgets the track and all times (the clock was set); counters go on.
  void reset();

 private:
  void reset_bias(FusionState& state, std::uint8_t source) const;
  Refusal check_time(const Measurement& measurement);
  bool jumps_ahead(const Measurement& measurement);
  void begin(std::int64_t time_ns);
  Use process(const Measurement& measurement);
  void insert(const Measurement& measurement);
  void take_snapshot();
  void drop_oldest_snapshot();

  Settings settings_;
  FusionCore core_;
  FusionState current_;
  StaticVector<FusionState, kSnapshots> snapshots_;  // oldest first
  StaticVector<Measurement, kMaxBuffered> buffer_;   // by time, then source; later than the oldest snapshot
  std::array<std::int64_t, kMaxSources> last_ns_{};  // of each source's accepted measurements
  std::array<bool, kMaxSources> heard_{};
  std::array<int, kMaxSources> ahead_run_{};
  std::array<std::int64_t, kMaxSources> stamped_ns_{};  // of each source's last measurement, accepted or not; 0: none
  std::array<std::array<std::int64_t, kMaxSources>, kMaxSources>
      stamped_then_ns_{};                                    // all, at each one's last accepted
  std::array<double, kMaxSources> step_s_{};                 // between its last two accepted
  std::array<std::int64_t, kMaxSources> jumped_since_ns_{};  // its first one ahead, with none of others since; 0: none
  std::array<std::uint64_t, static_cast<std::size_t>(Refusal::kCount)> refused_{};
  std::uint64_t late_ = 0;
  bool started_ = false;
};

}  // namespace pharos::fusion
