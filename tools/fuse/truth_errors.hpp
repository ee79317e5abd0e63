// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "pharos/fusion/target_state.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace pharos::tools {

/// A truth with a longer gap around a time does not tell the pose then.
inline constexpr double kMaxTruthGap_s = 0.2;

/// Errors of one fused state.
struct StateError {
  double rotation_rad = 0.0;
  double position_m = 0.0;
  double nees = 0.0;     // of the pose, over its six degrees of freedom
  bool outside = false;  // of a protection level that is available
};

/// Sums over all states with a truth.
class TruthErrors {
 public:
  /// TRUTH: what `pharos evaluate` reads, T_vehicle_target on the vehicle's clock. Throws host::InputError.
  explicit TruthErrors(const std::string& path);

  /// None where the state is not valid or the truth has a gap of more than 0.2 s.
  std::optional<StateError> add(const fusion::TargetState& state);
  std::size_t compared() const { return compared_; }
  /// One line for the user.
  std::string summary() const;

 private:
  evaluate::Trajectory<evaluate::TruthPose> truth_;
  std::size_t compared_ = 0, outside_ = 0, levels_ = 0;
  double rotation_rad2_ = 0.0, position_m2_ = 0.0, nees_ = 0.0;
};

}  // namespace pharos::tools
