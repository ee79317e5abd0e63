// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/calibrate/stationary_average.hpp"
#include "host/calibrate/unknowns.hpp"

namespace pharos::calibrate {

/// Input of one adjustment: starting values, priors and measurements.
struct BundleProblem {
  const std::vector<StationaryAverage>* intervals = nullptr;
  Homes home;        // of each stationary interval
  Unknowns nominal;  // prior means; poses and station poses are starting values
  PriorSigmas sigmas;
  std::vector<MeasuredLength> lengths;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  /// Error that the model does not explain, added to every mean angle, 1 sigma.
  double unmodelled_rad = 0.0;
};

/// One bearing after the adjustment.
struct BearingResidual {
  std::size_t interval = 0;
  std::size_t view = 0;       // index in StationaryAverage::rotors
  std::size_t bearing = 0;    // index in RotorView::bearings
  double residual_rad = 0.0;  // measured minus model, the common part taken out
  double sigma_rad = 0.0;     // own part, unmodelled part included
  /// Leverage of this bearing, 0 to 1: its residual's variance is sigma^2 (1 - leverage).
  double leverage = 0.0;
};

/// A measured length compared with what all other measurements give for it (leave-one-out).
struct LengthCheck {
  double predicted_m = 0.0;  // the distance that all other measurements give
  double predicted_sigma_m = 0.0;
  double sigmas_apart = 0.0;  // difference over the sigma of both
};

/// One calibration parameter: its prior and its estimate.
struct Parameter {
  std::string name;  // "sensor 3 x_m", "station BEC08E38 rotor x phase_rad"
  double prior = 0.0;
  double value = 0.0;
  double prior_sigma = 0.0;  // in the same body frame; 0: there was no prior (pose of a second station)
  double sigma = 0.0;
};

struct BundleResult {
  Unknowns unknowns;
  bool converged = false;
  std::vector<BearingResidual> residuals;
  std::vector<LengthCheck> lengths;
  std::vector<Parameter> parameters;
  /// Covariance of the parameters' errors, in their order. A second station's pose: rotation vector (rad) before
  /// translation (m), of the error delta of Pose::moved_by. Sensors that were never hit keep their prior.
  Eigen::MatrixXd covariance;
  /// Relative sigma of the target's size, before and after the recordings and lengths are used.
  double scale_prior_sigma = 0.0;
  double scale_sigma = 0.0;
};

/// Adjusts all unknowns together: sensor positions, rotor parameters, the second station's pose and the pose of every
/// stationary interval, with Huber's loss at three sigma on each bearing. The body frame is the one in which the
/// sensors that were hit lie on their nominal positions by least squares.
///
/// Cost: 30 intervals of 12 sensors take some 0.1 s, most of it the covariance: (parameters + 8 an interval and
/// station)^3.
BundleResult adjust(const BundleProblem& problem);

}  // namespace pharos::calibrate
