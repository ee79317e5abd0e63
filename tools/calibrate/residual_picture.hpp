// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/lighthouse_calibration.hpp"

namespace pharos::tools {

/// Draws a panel a rotor into an SVG file: for each sensor its rms residual before (grey) and after (blue),
/// logarithmic, in arc seconds. Throws InputError when the file cannot be written.
void write_residual_picture(const calibrate::LighthouseCalibration& calibration, const std::string& path);

}  // namespace pharos::tools
