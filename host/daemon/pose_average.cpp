// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pose_average.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace pharos::host {
namespace {

constexpr int kMostSteps = 10;
constexpr double kSmallStep_rad = 1e-12;

Pose<frame::Camera, frame::Target> mean_pose(const std::vector<AveragedFrame>& frames) {
  Pose<frame::Camera, frame::Target> mean = frames.front().estimate.pose;
  for (int step = 0; step < kMostSteps; ++step) {
    Vector6 sum = Vector6::Zero();
    for (const AveragedFrame& frame : frames) sum += pose_difference(frame.estimate.pose, mean);
    const Vector6 move = sum / static_cast<double>(frames.size());
    mean = mean.moved_by(move);
    if (move.head<3>().norm() < kSmallStep_rad) break;
  }
  return mean;
}

}  // namespace

std::optional<MeanPose> PoseAverage::push(const AveragedFrame& frame) {
  const bool continues =
      window_.empty() || (window_.back().flags == frame.flags && frame.utc_ns - window_.back().utc_ns <= kLongestGapNs);
  if (!continues) {
    given_up_ += static_cast<std::int64_t>(window_.size());
    window_.clear();
  }
  window_.push_back(frame);
  if (window_.size() < frames_) return std::nullopt;
  MeanPose result = mean();
  window_.clear();
  return result;
}

MeanPose PoseAverage::mean() const {
  const double count = static_cast<double>(window_.size());
  MeanPose result;
  result.estimate = window_.back().estimate;
  result.estimate.pose = mean_pose(window_);
  result.estimate.covariance = Matrix6::Zero();
  result.flags = window_.back().flags;
  double squares = 0.0;
  double after_first_ns = 0.0;
  for (const AveragedFrame& frame : window_) {
    const Matrix6& covariance = frame.estimate.covariance;
    result.estimate.covariance += covariance / (count * count);
    const Vector6 delta = pose_difference(frame.estimate.pose, result.estimate.pose);
    squares += delta.dot(covariance.ldlt().solve(delta));
    result.observations += frame.observations;
    after_first_ns += static_cast<double>(frame.utc_ns - window_.front().utc_ns);
  }
  result.utc_ns = window_.front().utc_ns + std::llround(after_first_ns / count);
  const double chi2 = count > 1.0 ? squares / (6.0 * (count - 1.0)) : 1.0;
  if (std::isfinite(chi2)) result.estimate.covariance *= std::max(1.0, chi2);
  result.moving = !(chi2 < kMovingChi2);
  return result;
}

}  // namespace pharos::host
