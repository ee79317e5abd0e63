// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/pose_summary.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kGamma = 5;

}  // namespace

PoseNumbers numbers_of(const tof::CameraFromTarget& pose) {
  const tof::TargetAngles angles = tof::angles_of(pose.R);
  return {pose.t.x() * kMmPerM,          pose.t.y() * kMmPerM,         pose.t.z() * kMmPerM,
          angles.alpha_rad * kDegPerRad, angles.beta_rad * kDegPerRad, angles.gamma_rad * kDegPerRad};
}

PoseNumbers sigmas_of(const tof::TargetPose& target) {
  PoseNumbers sigmas{};
  for (int k = 0; k < 3; ++k) {
    sigmas[static_cast<std::size_t>(k)] = kMmPerM * std::sqrt(target.covariance(3 + k, 3 + k));
  }
  // How the angles move with each turn, by central differences.
  constexpr double kStep = 1e-6;
  Matrix3 jacobian;
  for (int k = 0; k < 3; ++k) {
    Vector6 step = Vector6::Zero();
    step[k] = kStep;
    const PoseNumbers after = numbers_of(target.pose.moved_by(step));
    const PoseNumbers before = numbers_of(target.pose.moved_by(-step));
    for (int angle = 0; angle < 3; ++angle) {
      const auto i = static_cast<std::size_t>(3 + angle);
      jacobian(angle, k) = std::remainder(after[i] - before[i], 360.0) / (2.0 * kStep);
    }
  }
  const Matrix3 angles = jacobian * target.covariance.topLeftCorner<3, 3>() * jacobian.transpose();
  for (int k = 0; k < 3; ++k) sigmas[static_cast<std::size_t>(3 + k)] = std::sqrt(angles(k, k));
  return sigmas;
}

void PoseSummary::add(const tof::TargetPose& target, bool has_turn) {
  Entry entry{numbers_of(target.pose), sigmas_of(target), has_turn};
  // Gamma goes round: as near as can be to the first.
  const auto first = std::find_if(poses_.begin(), poses_.end(), [](const Entry& e) { return e.has_turn; });
  if (has_turn && first != poses_.end()) {
    const double reference = first->numbers[kGamma];
    entry.numbers[kGamma] = reference + std::remainder(entry.numbers[kGamma] - reference, 360.0);
  }
  poses_.push_back(entry);
}

std::size_t PoseSummary::frames_with_turn() const {
  return static_cast<std::size_t>(
      std::count_if(poses_.begin(), poses_.end(), [](const Entry& e) { return e.has_turn; }));
}

PoseNumbers PoseSummary::mean() const {
  PoseNumbers mean{};
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double sum = 0.0;
    double count = 0.0;
    for (const Entry& entry : poses_) {
      if (!counts(entry, k)) continue;
      sum += entry.numbers[k];
      count += 1.0;
    }
    mean[k] = count > 0.0 ? sum / count : 0.0;
  }
  return mean;
}

PoseNumbers PoseSummary::deviation() const {
  const PoseNumbers middle = mean();
  PoseNumbers deviation{};
  for (std::size_t k = 0; k < deviation.size(); ++k) {
    double squares = 0.0;
    double count = 0.0;
    for (const Entry& entry : poses_) {
      if (!counts(entry, k)) continue;
      squares += (entry.numbers[k] - middle[k]) * (entry.numbers[k] - middle[k]);
      count += 1.0;
    }
    deviation[k] = count > 1.0 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  }
  return deviation;
}

PoseNumbers PoseSummary::predicted() const {
  PoseNumbers predicted{};
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    double squares = 0.0;
    double count = 0.0;
    for (const Entry& entry : poses_) {
      if (!counts(entry, k)) continue;
      squares += entry.sigmas[k] * entry.sigmas[k];
      count += 1.0;
    }
    predicted[k] = count > 0.0 ? std::sqrt(squares / count) : 0.0;
  }
  return predicted;
}

}  // namespace pharos::tools
