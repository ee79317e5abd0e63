// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/mounting/source_table.hpp"
#include "pharos/fusion/target_state.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace pharos::tools {

/// Errors of the fused state and of each source's own poses, in bins of one metre of the true distance.
///
/// A source's pose is T_vehicle_target by the mounting; one whose feature is unknown (slam) has no error of its own. Of
/// two solutions the first one counts. The tilt is the angle of the feature's z axis; of the state, of the target's.
class RangeErrors {
 public:
  /// TRUTH: T_vehicle_target on the vehicle's clock. Throws host::InputError.
  RangeErrors(const std::string& truth, std::vector<host::SourceMounting> sources);

  void add(const fusion::TargetState& state);
  void add(std::size_t source, const host::SourceRow& row);
  /// `from_m,to_m,source,count,rms_deg,rms_tilt_deg,rms_mm`; the state's source is `fused`; rms_deg is empty where no
  /// pose has a turn. Throws host::InputError where it cannot be written.
  void write(const std::string& path) const;

 private:
  struct Sums {
    std::size_t count = 0, turned = 0;
    double rotation_rad2 = 0.0, tilt_rad2 = 0.0, position_m2 = 0.0;
  };
  void add(std::size_t column, double time_s, const host::VehicleFromTarget& pose, const Vector3& axis_target,
           bool turn);

  evaluate::Trajectory<evaluate::TruthPose> truth_;
  std::vector<host::SourceMounting> sources_;
  std::map<int, std::vector<Sums>> bins_;  // of each source, and at the end of the state
};

}  // namespace pharos::tools
