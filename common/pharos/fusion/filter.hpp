// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/fusion/motion_model.hpp"
#include "pharos/geometry/packed_symmetric.hpp"

namespace pharos::fusion {

using Covariance = PackedSymmetric<static_cast<std::size_t>(kStates)>;

/// What a measurement says about a state before it is used: its innovation, whitened.
struct Innovation {
  int rank = 0;
  Eigen::Matrix<double, 6, 12> derivatives;  // of the measured directions by pose and bias; `rank` rows
  Matrix6 factor = Matrix6::Zero();          // C of the innovation's covariance C C^T, lower triangular
  Vector6 whitened = Vector6::Zero();
  Vector6 residual = Vector6::Zero();  // pose error delta in the vehicle frame
  double nis = 0.0;                    // normalised innovation squared
  double log_det = 0.0;
  bool ok = false;  // false: the covariance is not positive definite
};

/// A source's slow error: the mean by which its pose differs from the state's.
struct BiasMean {
  Matrix3 R = Matrix3::Identity();
  Vector3 t = Vector3::Zero();
};

/// Variances of one axis of a source's own slow error, rotation (rad^2) and position (m^2).
struct OwnVariance {
  float rotation = 0.0F;
  float position = 0.0F;
};

/// Error-state Kalman filter of the target with a multiplicative attitude error (Lefferts, Markley, Shuster, "Kalman
/// filtering for spacecraft attitude estimation", J. Guidance 5 (1982); here in the vehicle frame: R_true = exp([d]x)
/// R) and a first-order Gauss-Markov bias of every source (augmented state, as in Bar-Shalom, Li, Kirubarajan,
/// "Estimation with applications to tracking and navigation", section 8.2).
///
/// State error, 42: rotation (rad), position (m), angular rate (rad/s), velocity (m/s), then six of each source's bias.
/// Cost with three sources: predict 4 k, correct 6 k multiplications.
class Filter {
 public:
  bool valid() const { return valid_; }
  /// Whether it began with a pose of all directions. Otherwise what the first one left out is 1 rad wide, and a filter
  /// that linearises about such a guess gains knowledge of it that no measurement gave.
  bool complete() const { return complete_; }
  void invalidate() { valid_ = false; }

  /// Starts from a pose with wide rates; directions that it does not measure are taken from `fill` (1 rad and 1 m
  /// wide).
  void start(const TargetMeasurement& measurement, const Settings& settings, const TargetPose* fill);
  /// To a time dt_s later.
  void predict(double dt_s, const Settings& settings);
  /// What `measurement` says, of its first or second pose.
  Innovation innovation(const TargetMeasurement& measurement, const Settings& settings, bool second = false) const;
  /// Whether the second of two poses fits better; false where there is none.
  bool second_fits_better(const TargetMeasurement& measurement, const Settings& settings) const;
  /// Corrects by an innovation of this very state.
  void correct(const Innovation& innovation, std::uint8_t source, const Settings& settings);
  /// Makes the bias of a relative source what explains this pose.
  void align(const TargetMeasurement& measurement, const Settings& settings);
  bool aligned(std::uint8_t source) const { return active_[source]; }
  /// Of a source's own slow error from now on (SourceSettings::own_rotation_ratio): the bias grows or shrinks with it,
  /// and what this may be wrong by is new noise of the bias.
  void set_own_variance(std::uint8_t source, const OwnVariance& variance, const Settings& settings);
  const OwnVariance& own_variance(std::uint8_t source) const { return own_[source]; }
  /// The source's bias is unknown again, as before its first measurement.
  void reset_bias(std::uint8_t source, const Settings& settings);

  const Kinematics& mean() const { return mean_; }
  const BiasMean& bias(std::uint8_t source) const { return bias_[source]; }
  /// Of rotation and position; of all twelve in the same order and rates after them.
  Matrix6 pose_covariance() const;
  Eigen::Matrix<double, kKinematic, kKinematic> kinematic_covariance() const;
  /// Pose that the source would measure.
  TargetPose expected_pose(std::uint8_t source, const SourceSettings& settings) const;

 private:
  void predict_step(double dt_s, const Settings& settings);
  void predict_biases(double dt_s, const Settings& settings);
  Matrix6 stationary_bias(std::uint8_t source, const SourceSettings& settings) const;
  void scale_bias(std::uint8_t source, double rotation, double position);
  void add_bias(std::uint8_t source, const Matrix6& covariance);
  void set_bias_block(std::uint8_t source, const Matrix6& block);
  void shift(const std::array<double, kStates>& delta);

  Kinematics mean_;
  std::array<BiasMean, kMaxSources> bias_{};
  std::array<bool, kMaxSources> active_{};  // its bias is part of the state (has been corrected)
  std::array<OwnVariance, kMaxSources> own_{};
  Covariance covariance_{};
  bool valid_ = false;
  bool complete_ = false;
};

/// `pose` moved along the directions that were not measured, to where it is nearest to `reference`.
TargetPose completed(const TargetPose& pose, const Directions& directions, const TargetPose& reference);

}  // namespace pharos::fusion
