// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/measurements/source_faults.hpp"

#include <algorithm>
#include <numbers>

namespace pharos::sim {
namespace {

constexpr double kTimePerSigma_s = 0.005;
constexpr double kOutlierChance = 0.6;  // of a pose within a burst
constexpr double kBurst_s = 1.0;        // every other second
constexpr double kMinMirrored_rad = 0.3;

Vector3 random_vector(RandomStream& random) { return {random.normal(), random.normal(), random.normal()}; }

Vector6 unit6(RandomStream& random) {
  Vector6 v;
  v << random_vector(random), random_vector(random);
  return v.normalized();
}

}  // namespace

SourceFaultMaker::SourceFaultMaker(const SourceFault& fault, const MeasuredSource& source, std::uint64_t seed)
    : fault_(fault), source_(source), random_(seed, "source fault") {
  direction_ = unit6(random_);
  ramp_s_ = random_.uniform(3.0, 20.0);
  sign_ = random_.chance(0.5) ? 1.0 : -1.0;
  half_turn_ = random_.chance(0.5);
  other_.R = rotation_exp(random_vector(random_));
  other_.t = random_vector(random_).normalized() * random_.uniform(0.3, 2.0);
}

void SourceFaultMaker::shift(SimulatedPose& pose, const Vector6& direction, double size) const {
  Vector6 delta;
  delta << direction.head<3>() * source_.noise_rad, direction.tail<3>() * source_.noise_m;
  pose.pose = pose.pose.moved_by(size * delta);
}

// The feature's normal on the other side of the line of sight, or a half turn about the normal.
void SourceFaultMaker::mirror(SimulatedPose& pose) const {
  const Vector3 sight = pose.pose.t.normalized();
  const Vector3 normal = pose.pose.R.col(2);
  const Vector3 axis = sight.cross(normal);
  const double tilt = 2.0 * std::atan2(axis.norm(), sight.dot(normal));
  if (half_turn_ && !source_.no_roll) {
    pose.pose.R = rotation_exp(std::numbers::pi * normal) * pose.pose.R;
  } else {
    const Vector3 about = axis.norm() > 1e-6 ? Vector3(axis.normalized()) : Vector3(normal.unitOrthogonal());
    pose.pose.R = rotation_exp(-about * std::max(kMinMirrored_rad, tilt)) * pose.pose.R;
  }
}

void SourceFaultMaker::apply(SimulatedPose& pose) {
  const bool active = pose.time_s >= fault_.from_s && pose.time_s < fault_.until_s;
  if (!active) {
    frozen_ = pose.pose;
    return;
  }
  pose.faulty = true;
  const double since_s = pose.time_s - fault_.from_s;
  switch (fault_.kind) {
    case SourceFaultKind::kNone:
      pose.faulty = false;
      break;
    case SourceFaultKind::kStep:
      shift(pose, direction_, fault_.size);
      break;
    case SourceFaultKind::kRamp:
      shift(pose, direction_, fault_.size * std::min(1.0, since_s / ramp_s_));
      break;
    case SourceFaultKind::kFreeze:
      if (frozen_) pose.pose = *frozen_;
      break;
    case SourceFaultKind::kWrongTime:
      pose.time_s += sign_ * fault_.size * kTimePerSigma_s;
      break;
    case SourceFaultKind::kWrongScale:
      pose.pose.t *= 1.0 + sign_ * fault_.size * source_.noise_m / pose.pose.t.norm();
      break;
    case SourceFaultKind::kMirrored:
      mirror(pose);
      break;
    case SourceFaultKind::kWrongTarget:
      pose.pose = {pose.pose.R * other_.R, pose.pose.t + other_.t};
      break;
    case SourceFaultKind::kOutliers:
      if (static_cast<long>(since_s / kBurst_s) % 2 == 0 && random_.chance(kOutlierChance)) {
        shift(pose, unit6(random_), fault_.size);
      }
      break;
  }
}

}  // namespace pharos::sim
