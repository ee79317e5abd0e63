// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "host/calibrate/stationary_average.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::calibrate {

/// Pose of one stationary interval from one station alone.
struct StartPose {
  LighthouseFromBody pose;  // T_station_body
  bool ambiguous = false;   // another pose fits nearly as well
};

/// Solves one interval from one station, and removes the candidates that do not fit the rigid body (reflections) from
/// `still`; `sigma_rad` is the angle error from errors of body and station. Empty, with `still` unchanged, where there
/// is no pose (fewer than four sensors, …).
std::optional<StartPose> start_pose(StationaryAverage& interval, std::size_t station, const Target& target,
                                    const lighthouse::StationCalibration& calibration, lighthouse::ModelForm form,
                                    double sigma_rad);

}  // namespace pharos::calibrate
