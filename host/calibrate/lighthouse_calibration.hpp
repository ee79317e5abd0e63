// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/bundle.hpp"
#include "host/calibrate/sensor_fits.hpp"
#include "host/calibrate/stationary_average.hpp"
#include "host/calibrate/sweep_log.hpp"

namespace pharos::calibrate {

/// What a calibration is made from.
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
  std::size_t poses = 0;               // of those, in places of their own
  std::size_t intervals_unsolved = 0;  // no single pose fitted them
  std::size_t bearings_rejected = 0;   // means that fit no rigid body (reflections, hands)
  std::size_t unknown_sensors = 0;     // sensors hit that the target has not
  double unmodelled_rad = 0.0;         // what the fit leaves beyond the noise of the means, 1 sigma
  bool scale_measured = false;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
};

/// Calibrates target and stations. Throws host::InputError, one line saying what to do, where it cannot: the target
/// never rested or never moved, fewer than six poses, a station without identity, two slots with one identity, more
/// than two stations, lengths between sensors that are not there or that contradict the rest by five sigma.
///
/// StationaryAverage stretches -> averages with their correlated noise -> a pose each -> bundle adjustment -> the poses
/// solved anew with what was learnt (a still that was in its mirror image comes back) -> bundle adjustment. What the
/// fit leaves beyond the noise is taken as an error of every mean, so that the covariance stays honest for real
/// stations.
LighthouseCalibration calibrate_lighthouse(LighthouseCalibrationInput input);

}  // namespace pharos::calibrate
