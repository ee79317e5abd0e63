// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/fusion_state.hpp"

namespace pharos::fusion {

enum class Mode : std::uint8_t {
  kSearching,  // no track yet
  kSingle,     // one source
  kFused,      // two sources and more
  kConflict,   // two sources contradict each other and nothing tells which is wrong
  kCoasting,   // predicted only
  kLost,       // no track any more
};

struct SourceReport {
  SourceState state = SourceState::kSilent;
  FaultKind reason = FaultKind::kStep;  // where excluded
  bool heard = false;                   // there was a measurement
  double age_s = 0.0;                   // of the last one
  double normalised_innovation = 0.0;   // NIS over its degrees of freedom, of the last measurement; 1 is expected
};

/// One of two contradicting solutions.
struct ConflictSide {
  std::uint8_t without = 0;  // the source that this solution does not use
  bool valid = false;
  TargetPose pose;
  Matrix6 covariance = Matrix6::Zero();
};

/// The fused answer at a time.
struct TargetState {
  std::int64_t time_ns = 0;
  Mode mode = Mode::kSearching;
  bool valid = false;  // kinematics and covariance are there: single, fused, conflict, coasting
  Kinematics kinematics;
  /// Of rotation (rad), position (m), angular rate (rad/s), velocity (m/s).
  Eigen::Matrix<double, kKinematic, kKinematic> covariance = Eigen::Matrix<double, kKinematic, kKinematic>::Zero();
  ProtectionLevel protection;
  StaticVector<SourceReport, kMaxSources> sources;
  std::array<ConflictSide, 2> conflict;  // valid in mode conflict
};

}  // namespace pharos::fusion
