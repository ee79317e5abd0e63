// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/mounting/mounting_calibration.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// Rows source,parameter,value,sigma: rotation vectors in degrees, positions in mm, offsets in ms.
void write_mounting_parameters(const calibrate::MountingCalibration& calibration, const OutputOptions& options);

/// Residuals, what is not observable and warnings on standard error.
void note_mounting(const calibrate::MountingCalibration& calibration);

/// An HTML page without scripts: parameters with sigmas, and each source's residuals over time as SVG. Throws
/// InputError.
void write_mounting_report(const calibrate::MountingCalibration& calibration, const std::string& path);

}  // namespace pharos::tools
