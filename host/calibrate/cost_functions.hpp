// SPDX-License-Identifier: Apache-2.0
#pragma once

// Cost functions of the bundle adjustment for Ceres. Rows are whitened: unit variance. In a bearing's row the part
// common to its rotor and stationary interval is a separate unknown with its own sigma: that is equivalent to whitening
// the rotor's bearings with their full correlation, and lets the robust loss treat every sensor separately.
#include <ceres/cost_function.h>

#include <vector>

#include "host/calibrate/stationary_average.hpp"
#include "host/calibrate/unknowns.hpp"

namespace pharos::calibrate {

/// The constants of a bearing in one adjustment.
struct BearingRow {
  Axis axis = Axis::kX;
  lighthouse::ModelForm form = lighthouse::ModelForm::kForm1;
  double raw_rad = 0.0;
  double sigma_rad = 1.0;
  LighthouseFromBody T_home_body;                           // the pose block's delta is relative to this one
  std::optional<ReferenceFromStation> T_reference_station;  // present: the station is not the interval's home station
};

/// (raw - common - model) / sigma. Blocks: rotor (5), pose delta (6), sensor (3), common (1)[, station delta (6)].
ceres::CostFunction* bearing_cost(const BearingRow& row);

/// (x - mean) / sigma of every element of one block.
ceres::CostFunction* prior_cost(const std::vector<double>& mean, const std::vector<double>& sigma);

/// (|a - b| - length) / sigma. Blocks: sensor a (3), sensor b (3).
ceres::CostFunction* length_cost(const MeasuredLength& length);

/// Six rows that fix the body frame: mean displacement of the sensors from `nominal_m` and mean rotation about their
/// centroid are zero in the least-squares sense. Blocks: sensors (3 each) in the same order.
ceres::CostFunction* frame_cost(const std::vector<Vector3>& nominal_m);

}  // namespace pharos::calibrate
