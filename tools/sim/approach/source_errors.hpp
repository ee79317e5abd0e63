// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "host/mounting/mounting.hpp"
#include "tools/sim/approach/approach_scenario.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// Standard normal numbers.
Vector3 normal3(RandomStream& random);
Vector6 normal6(RandomStream& random);

/// A covariance and its square root, rotation before translation, of an error of the feature's pose.
struct PoseNoise {
  Matrix6 root = Matrix6::Zero();
  Matrix6 covariance() const { return root * root.transpose(); }
};

/// By how much the errors at this range exceed those at noise.range_m.
double range_factor(const RangeNoise& noise, double range_m);

/// White noise of a source at this pose. `p_noise` is the point of the feature frame whose position has lateral_mm and
/// depth_mm (the target's centre for slam, whose own origin is far from it); `ratio` multiplies every sigma.
PoseNoise white_noise(const ApproachSource& source, const host::SensorFromFeature& pose, const Vector3& p_noise,
                      double ratio);

/// The attitude of a flat target that looks nearly the same: its normal mirrored at the line of sight. Empty where both
/// are within `min_angle_rad`.
std::optional<host::SensorFromFeature> mirrored(const host::SensorFromFeature& pose, double min_angle_rad);

/// The pose with the same z axis whose turn says nothing: R = Rx(theta) Ry(gamma) diag(1,-1,-1).
host::SensorFromFeature without_turn(const host::SensorFromFeature& pose);

/// The source's slow errors over time: Gauss-Markov bias and random walk.
class SlowErrors {
 public:
  SlowErrors(const ApproachSource& source, RandomStream& random);
  /// To `time_s`, later than before.
  void advance(double time_s, RandomStream& random);
  /// Error of the pose in the sensor frame; the bias grows with the range as the noise does.
  Vector6 error(double factor) const { return factor * bias_ + drift_; }
  double scale() const { return scale_; }

 private:
  Vector6 bias_sigma_, drift_sigma_;
  double time_constant_s_;
  Vector6 bias_, drift_ = Vector6::Zero();
  double scale_;
  std::optional<double> last_s_;
};

}  // namespace pharos::sim
