// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// A map point and its position in a frame.
struct Observation {
  Vector3 point_m = Vector3::Zero();  ///< in the target's frame
  Vector2 pixel = Vector2::Zero();
  double right_u_px = -1.0;  ///< below 0: mono
  double variance_px2 = 1.0;

  bool stereo() const { return right_u_px >= 0.0; }
};

/// Observation of the point by a frame's feature, with the feature's own variance.
Observation observation_of(const Feature& feature, const Vector3& point_m);

/// A point nearer to the camera, or behind it, cannot have been observed.
inline constexpr double kMinDepth_m = 1e-3;

/// 95 % of chi-squared with two and three degrees of freedom: beyond it an observation is an outlier.
inline constexpr double kMonoChi2 = 5.991;
inline constexpr double kStereoChi2 = 7.815;
/// Threshold of Huber's cost: two sigma, because errors below the limits above are not Gaussian either.
inline constexpr double kHuberChi2 = 4.0;

/// x - pi(R X + t) of (10), px. The third row is not that of the right column, whose error is correlated with the left
/// one's, but that of the disparity, over kDisparityFraction so that all rows have one variance; 0 for a mono feature.
Vector3 residual_of(const Observation& observation, const StereoCamera& camera, const CameraFromTarget& pose);
/// d residual / d delta of Pose::moved_by: rotation before translation.
Eigen::Matrix<double, 3, 6> residual_jacobian(const Observation& observation, const StereoCamera& camera,
                                              const CameraFromTarget& pose);

struct PoseOnly {
  CameraFromTarget pose;
  Matrix6 covariance = Matrix6::Zero();  ///< of delta, from the inliers; zero where the pose is not determined
  std::vector<bool> inlier;
  int inliers = 0;
  double rms_px = 0.0;  ///< of the inliers' residuals, a coordinate each
};

/// Factor by which residuals before the test of chi-squared exceed the assumed variances: the median of their
/// chi-squared over that of the distribution, at least 1. The residuals that pass the test cannot tell: they are as
/// assumed. 1 for fewer than 20 observations.
double variance_factor(const std::vector<Observation>& observations, const StereoCamera& camera,
                       const CameraFromTarget& pose);

/// Factor by which the inliers' errors move the pose further than independent ones would, at least 1: neighbouring
/// points have errors in common (light, gloss, stereo), which no residual alone shows. From the pulls of groups of
/// neighbours at the pose (the sandwich estimator; trace over that of the inverse normal equations). 1 for fewer than
/// six groups, of 15 inliers at least.
double correlation_factor(const std::vector<Observation>& observations, const StereoCamera& camera,
                          const PoseOnly& placed);

/// (10): least squares of the reprojections over the pose alone, Huber's cost; outliers are determined anew four times.
/// Some 0.3 ms for 300 points.
PoseOnly adjust_pose(const std::vector<Observation>& observations, const StereoCamera& camera,
                     const CameraFromTarget& start);

}  // namespace pharos::slam
