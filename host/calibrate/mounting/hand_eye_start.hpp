// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/mounting/mounting.hpp"
#include "host/mounting/source_table.hpp"

namespace pharos::calibrate {

/// Poses of the given source further apart are not interpolated: at 20 deg/s a target turns by 10 deg in this time.
inline constexpr double kMaxPathGap_s = 0.5;

/// The target's pose at times of one source.
struct TimedTarget {
  double time_s = 0.0;
  host::VehicleFromTarget pose;
};

/// Linear and slerp between the two neighbours; empty outside, and across a gap of more than `max_gap_s`.
std::optional<host::VehicleFromTarget> target_at(const std::vector<TimedTarget>& path, double time_s, double max_gap_s);

struct HandEyeStart {
  host::VehicleFromSensor T_vehicle_sensor;
  host::TargetFromFeature T_target_feature;
  double time_offset_s = 0.0;
  double rms_m = 0.0;  // of the predicted features' positions
};

/// A T_target_feature = T_vehicle_sensor B in closed form: rotations from the null space of the stacked linear
/// equations (Shah, "Solving the robot-world/hand-eye calibration problem using the Kronecker product", J. Mechanisms
/// Robotics 5 (2013)), then translations by least squares. Of poses without turn only the axis enters. Empty where the
/// motion does not determine it, or fewer than 10 poses are common.
std::optional<HandEyeStart> hand_eye_start(const std::vector<TimedTarget>& target,
                                           const std::vector<host::SourceRow>& rows, double time_offset_s);

/// The offset within +-max_offset_s whose closed form fits best, in steps of 25 ms.
std::optional<HandEyeStart> search_hand_eye_start(const std::vector<TimedTarget>& target,
                                                  const std::vector<host::SourceRow>& rows, double max_offset_s);

/// Root mean square rotation about the principal axes of the target's attitudes, descending, rad.
Vector3 excitation_rad(const std::vector<TimedTarget>& target);

}  // namespace pharos::calibrate
