// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/daemon/fusion/pose_intake.hpp"
#include "host/fusion/target_fuser.hpp"

namespace pharos::host {

/// Work for the fusion: a pose, or only a look at the state.
struct FusionJob {
  std::int64_t now_ns = 0;  // UTC: the state is predicted to it
  std::optional<TakenPose> pose;
  bool restart = false;  // before the pose: forget the track
};

struct FusionResult {
  fusion::TargetState state;
  fusion::Outcome outcome;  // of the pose
  fusion::FusionCounters counters;
  std::int64_t restarts = 0;  // a restart that was asked for, or the times of all sources went back
};

/// The estimator as pharosd runs it: jobs in their order to states. The same jobs give the same states bit by bit.
/// Independent of threads, clocks and LCM.
class FusionStage {
 public:
  /// Throws InputError as TargetFuser.
  explicit FusionStage(const VehicleConfig& config);

  FusionResult take(const FusionJob& job);
  const std::vector<std::string>& names() const { return fuser_.names(); }

 private:
  void note_time(const fusion::Outcome& outcome, const TakenPose& pose);

  TargetFuser fuser_;
  int back_run_ = 0;  // consecutive poses refused for times far behind
  std::int64_t restarts_ = 0;
};

}  // namespace pharos::host
