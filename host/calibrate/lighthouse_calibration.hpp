// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/bundle.hpp"
#include "host/calibrate/sensor_fits.hpp"
#include "host/calibrate/stationary_average.hpp"
#include "host/calibrate/sweep_log.hpp"

namespace pharos::calibrate {

/// Input of a calibration.
struct LighthouseCalibrationInput {
  std::vector<RecordingLog> recordings;
  Target target;  // nominal
  std::vector<MeasuredLength> lengths;
  PriorSigmas sigmas;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
};

struct LighthouseCalibration {
  BundleResult bundle;
  std::vector<SensorFit> fits;
  std::size_t intervals = 0;           // used
  std::size_t poses = 0;               // of those, distinct ones
  std::size_t intervals_unsolved = 0;  // no single pose fitted them
  std::size_t bearings_rejected = 0;   // means that fit no rigid body (reflections, hands)
  std::size_t unknown_sensors = 0;     // sensors hit that are not in the target's table
  double unmodelled_rad = 0.0;         // residual beyond the noise of the means, 1 sigma
  bool scale_measured = false;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
};

/// Calibrates target and stations. Throws host::InputError, one line saying what to do, where it cannot: the target was
/// never stationary or never moved, fewer than six poses, a station without identity, two slots with one identity, more
/// than two stations, lengths between unknown sensors or lengths that contradict all other measurements by five sigma.
///
/// Stationary intervals -> averages with their correlated noise -> a pose each -> bundle adjustment -> poses solved
/// again with the calibrated parameters (corrects intervals solved as the mirror image) -> bundle adjustment. Residuals
/// beyond the noise count as an error of every mean, so that the covariance is consistent for real stations.
LighthouseCalibration calibrate_lighthouse(LighthouseCalibrationInput input);

}  // namespace pharos::calibrate
