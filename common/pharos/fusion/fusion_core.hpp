// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/target_state.hpp"

namespace pharos::fusion {

/// What became of a measurement that was processed.
enum class Use : std::uint8_t {
  kUsed,
  kSearching,  // used to begin a track
  kGated,      // too far from the prediction
  kAmbiguous,  // both of its solutions fit
  kFrozen,     // the same pose again
  kExcluded,   // of a source that is not believed
  kConflict,   // of one of two sources that contradict each other
  kNotUsable,  // a relative or incomplete pose before there is a track
};

/// Processes measurements in the order of time. All state is in FusionState, so that a copy of it is a place to go back
/// to.
class FusionCore {
 public:
  /// `settings` are checked (check_settings) and outlive this object.
  explicit FusionCore(const Settings& settings);

  /// `measurement` is checked (check_measurement) and not before state.time_ns.
  Use push(FusionState& state, const Measurement& measurement) const;
  /// Predicted to `time_ns`, which may lie before or after the state's.
  TargetState report(const FusionState& state, std::int64_t time_ns) const;

 private:
  // search.cpp
  Use search(FusionState& state, const Measurement& measurement) const;
  void begin_search(FusionState& state, const Measurement& measurement) const;
  void begin_track(FusionState& state, std::int64_t time_ns) const;
  void restart(FusionState& state) const;
  // fusion_core.cpp
  void predict(FusionState& state, std::int64_t time_ns) const;
  Use track(FusionState& state, const Measurement& measurement) const;
  Use use_or_gate(FusionState& state, const Measurement& raw) const;
  void note_own_error(FusionState& state, const Measurement& raw) const;
  TargetMeasurement view(const FusionState& state, const Measurement& raw, const TargetPose* reference) const;
  void place_feature(FusionState& state, const Measurement& raw) const;
  void correct_main(FusionState& state, TargetMeasurement& measurement, const Innovation& innovation,
                    bool second) const;
  void correct_without(FusionState& state, std::size_t k, const TargetMeasurement& measurement, bool second) const;
  void drop_without(FusionState& state, std::size_t k) const;
  bool is_lost(const FusionState& state) const;
  double gate(int rank) const { return gates_[static_cast<std::size_t>(rank)]; }
  // readmission.cpp
  Use prove(FusionState& state, const Measurement& raw) const;
  void prove_in_conflict(FusionState& state, const Measurement& raw) const;
  void readmit(FusionState& state, std::uint8_t source) const;
  void examine_contradiction(FusionState& state, const TargetMeasurement& measurement,
                             const Innovation& innovation) const;
  void refute(FusionState& state) const;
  // exclusion.cpp
  void exclude(FusionState& state, std::uint8_t source, FaultKind why) const;
  void examine_gated(FusionState& state, const TargetMeasurement& measurement, const Innovation& innovation) const;
  void examine_separations(FusionState& state) const;
  bool source_is_alone(const FusionState& state, std::uint8_t source) const;
  double misfit(const FusionState& state, std::size_t without) const;
  double separation(const FusionState& state, std::size_t source, bool rotation) const;
  std::uint8_t sources() const { return static_cast<std::uint8_t>(settings_.sources.size()); }  // at most kMaxSources
  // unresolved.cpp
  void mark_unresolved(FusionState& state, std::uint8_t source) const;
  void note_unresolved_restart(FusionState& state) const;
  void restart_unresolved(FusionState& state) const;
  void examine_unresolved(FusionState& state) const;
  // conflict.cpp
  void enter_conflict(FusionState& state, std::uint8_t first, std::uint8_t second) const;
  Use track_in_conflict(FusionState& state, const Measurement& raw) const;
  void examine_conflict(FusionState& state) const;
  void end_conflict(FusionState& state, std::uint8_t wrong, FaultKind why) const;
  // report
  bool is_contradicted(const FusionState& state, std::int64_t time_ns) const;
  Mode mode_at(const FusionState& state, std::int64_t time_ns) const;

  const Settings& settings_;
  std::array<double, 7> gates_{};  // by degrees of freedom
  double separation_threshold_ = 0.0;
  ProtectionFactors factors_;
};

inline double seconds(std::int64_t later_ns, std::int64_t earlier_ns) {
  return static_cast<double>(later_ns - earlier_ns) * 1e-9;
}

}  // namespace pharos::fusion
