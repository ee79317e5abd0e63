// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the bundle adjustment minimises, row by row, as Ceres takes it. Rows are whitened: unit variance. A row of a
// bearing has the part common to its rotor and still as an unknown of its own with its own sigma: that is the same as
// whitening the rotor's bearings with their full correlation, and lets the robust loss judge every sensor alone.
#include <ceres/cost_function.h>

#include <vector>

#include "host/calibrate/stationary_average.hpp"
#include "host/calibrate/unknowns.hpp"

namespace pharos::calibrate {

/// What does not change of a bearing during one adjustment.
struct BearingRow {
  Axis axis = Axis::kX;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  double raw_rad = 0.0;
  double sigma_rad = 1.0;
  LighthouseFromBody T_home_body;                           // the pose block's delta is about this one
  std::optional<ReferenceFromStation> T_reference_station;  // present: the station is not the still's home
};

/// (raw - common - model) / sigma. Blocks: rotor (5), pose delta (6), sensor (3), common (1)[, station delta (6)].
ceres::CostFunction* bearing_cost(const BearingRow& row);

/// (x - mean) / sigma of every element of one block.
ceres::CostFunction* prior_cost(const std::vector<double>& mean, const std::vector<double>& sigma);

/// (|a - b| - length) / sigma. Blocks: sensor a (3), sensor b (3).
ceres::CostFunction* length_cost(const MeasuredLength& length);

/// Six rows that keep the body frame: the mean displacement of the sensors from `nominal_m` is zero and so is their
/// mean turn about the middle, as least squares would place them. Blocks: sensors (3 each) in the same order.
ceres::CostFunction* frame_cost(const std::vector<Vector3>& nominal_m);

}  // namespace pharos::calibrate
