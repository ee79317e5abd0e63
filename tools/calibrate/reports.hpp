// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/lighthouse_calibration.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// `parameter,prior,value,prior_sigma,sigma,told`: every parameter; `told` is the fraction of its prior variance that
/// the recordings removed, 0 to 1.
void write_parameters(const calibrate::LighthouseCalibration& calibration, const OutputOptions& options);

/// `station_id,axis,sensor,stills,before_arcsec,after_arcsec`: rms of each sensor on each rotor.
void write_residuals(const calibrate::LighthouseCalibration& calibration, const OutputOptions& options);

/// Summary for the user on standard error: data used, residuals, unobservable parameters.
void note_outcome(const calibrate::LighthouseCalibration& calibration);

}  // namespace pharos::tools
