// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

// Each step reduces the error of the mean to second order in the spread.
constexpr int kMeanSteps = 5;

Matrix3 mean_rotation(const std::vector<LighthouseFromBody>& poses) {
  Matrix3 mean = poses.front().R;
  for (int step = 0; step < kMeanSteps; ++step) {
    Vector3 sum = Vector3::Zero();
    for (const LighthouseFromBody& pose : poses) sum += rotation_log(pose.R * mean.transpose());
    mean = rotation_exp(sum / static_cast<double>(poses.size())) * mean;
  }
  return mean;
}

}  // namespace

PoseSpread spread_of(const std::vector<LighthouseFromBody>& poses) {
  const auto count = static_cast<double>(poses.size());
  const Matrix3 mean_R = mean_rotation(poses);
  Vector3 mean_t = Vector3::Zero();
  for (const LighthouseFromBody& pose : poses) mean_t += pose.t / count;
  double rotation = 0.0;
  double position = 0.0;
  for (const LighthouseFromBody& pose : poses) {
    rotation += rotation_log(pose.R * mean_R.transpose()).squaredNorm();
    position += (pose.t - mean_t).squaredNorm();
  }
  return {std::sqrt(rotation / count) * kDegPerRad, std::sqrt(position / count) * kMmPerM};
}

PoseError error_of(const LighthouseFromBody& estimate, const LighthouseFromBody& truth) {
  return {rotation_angle_between(estimate.R, truth.R) * kDegPerRad, (estimate.t - truth.t).norm() * kMmPerM};
}

double median_of(std::vector<double> values) { return quantile_of(std::move(values), 0.5); }

double quantile_of(std::vector<double> values, double fraction) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(fraction * last));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace pharos::tools
