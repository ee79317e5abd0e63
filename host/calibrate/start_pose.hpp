// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "host/calibrate/stationary_average.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::calibrate {

/// A still's pose before one station, alone.
struct StartPose {
  LighthouseFromBody pose;  // T_station_body
  bool ambiguous = false;   // another pose fits nearly as well
};

/// Solves one still before one station, and strikes the candidates that the rigid body refuses (reflections) from
/// `still`; `sigma_rad` is what the body's and the station's errors put on an angle. Empty, with the still unchanged,
/// where no pose can be had (fewer than four sensors, …).
std::optional<StartPose> start_pose(StationaryAverage& interval, std::size_t station, const Target& target,
                                    const lighthouse::StationCalibration& calibration, lighthouse::ModelForm form,
                                    double sigma_rad);

}  // namespace pharos::calibrate
