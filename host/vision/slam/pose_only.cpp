// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pose_only.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/vision/slam/point_groups.hpp"
#include "pharos/optimize/descent.hpp"
#include "pharos/optimize/least_squares.hpp"

namespace pharos::slam {
namespace {

constexpr int kRounds = 4;
constexpr int kMaxIterations = 9;
// Convergence: decrease of chi-squared in the last step, a thousandth of a standard deviation, squared.
constexpr double kConverged = 1e-6;
constexpr int kMinPosePoints = 3;

double limit_of(const Observation& observation) { return observation.stereo() ? kStereoChi2 : kMonoChi2; }

using Normal = optimize::NormalEquations<6>;

// Reprojections of the inliers, Huber's cost.
struct PoseDescent : optimize::LeastSquares<6, CameraFromTarget> {
  PoseDescent(const std::vector<Observation>& o, const std::vector<bool>& i, const StereoCamera& c)
      : observations(o), inlier(i), camera(c) {}

  Normal linearise(const CameraFromTarget& pose) const {
    Normal normal;
    for (std::size_t k = 0; k < observations.size(); ++k) {
      const Observation& observation = observations[k];
      if (!inlier[k] || (pose * observation.point_m).z() < kMinDepth_m) continue;
      const Vector3 e = residual_of(observation, camera, pose);
      const Eigen::Matrix<double, 3, 6> J = residual_jacobian(observation, camera, pose);
      const double chi2 = e.squaredNorm() / observation.variance_px2;
      const bool far = chi2 > kHuberChi2;
      const double weight = (far ? std::sqrt(kHuberChi2 / chi2) : 1.0) / observation.variance_px2;
      normal.cost += far ? 2.0 * std::sqrt(kHuberChi2 * chi2) - kHuberChi2 : chi2;
      normal.matrix += weight * J.transpose() * J;
      normal.gradient += weight * J.transpose() * e;
    }
    return normal;
  }
  CameraFromTarget moved(const CameraFromTarget& pose, const Vector6& delta) const { return pose.moved_by(delta); }

  const std::vector<Observation>& observations;
  const std::vector<bool>& inlier;
  const StereoCamera& camera;
};

}  // namespace

Observation observation_of(const Feature& feature, const Vector3& point_m) {
  return {point_m, feature.pixel, feature.stereo() ? feature.right_u_px : -1.0, feature.variance_px2()};
}

Vector3 residual_of(const Observation& observation, const StereoCamera& camera, const CameraFromTarget& pose) {
  const Vector3 predicted = camera.project(pose * observation.point_m);
  const double disparity = observation.pixel.x() - observation.right_u_px, expected = predicted.x() - predicted.z();
  return {observation.pixel.x() - predicted.x(), observation.pixel.y() - predicted.y(),
          observation.stereo() ? (disparity - expected) / kDisparityFraction : 0.0};
}

Eigen::Matrix<double, 3, 6> residual_jacobian(const Observation& observation, const StereoCamera& camera,
                                              const CameraFromTarget& pose) {
  const Vector3 turned = pose.R * observation.point_m;
  const Vector3 p = turned + pose.t;
  const double over_z = 1.0 / p.z(), over_z2 = over_z * over_z;
  Matrix3 J = Matrix3::Zero();
  J(0, 0) = -camera.fx_px * over_z;
  J(0, 2) = camera.fx_px * p.x() * over_z2;
  J(1, 1) = -camera.fy_px * over_z;
  J(1, 2) = camera.fy_px * p.y() * over_z2;
  if (observation.stereo()) J(2, 2) = camera.fx_px * camera.baseline_m * over_z2 / kDisparityFraction;
  Eigen::Matrix<double, 3, 6> out;
  out.leftCols<3>() = -J * skew(turned);
  out.rightCols<3>() = J;
  return out;
}

namespace {

double rms_of(const std::vector<Observation>& observations, const StereoCamera& camera, const PoseOnly& result) {
  double sum_px2 = 0.0;
  int coordinates = 0;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (!result.inlier[k]) continue;
    sum_px2 += residual_of(observations[k], camera, result.pose).squaredNorm();
    coordinates += observations[k].stereo() ? 3 : 2;
  }
  return coordinates == 0 ? 0.0 : std::sqrt(sum_px2 / coordinates);
}

}  // namespace

double variance_factor(const std::vector<Observation>& observations, const StereoCamera& camera,
                       const CameraFromTarget& pose) {
  constexpr std::size_t kMinObservations = 20;
  constexpr double kMedianChi2Stereo = 2.366, kMedianChi2Mono = 1.386;  // three and two degrees of freedom
  std::vector<double> factors;
  for (const Observation& observation : observations) {
    if ((pose * observation.point_m).z() < kMinDepth_m) continue;
    const double chi2 = residual_of(observation, camera, pose).squaredNorm() / observation.variance_px2;
    factors.push_back(chi2 / (observation.stereo() ? kMedianChi2Stereo : kMedianChi2Mono));
  }
  if (factors.size() < kMinObservations) return 1.0;
  const auto middle = factors.begin() + static_cast<std::ptrdiff_t>(factors.size() / 2);
  std::nth_element(factors.begin(), middle, factors.end());
  return std::max(1.0, *middle);
}

double correlation_factor(const std::vector<Observation>& observations, const StereoCamera& camera,
                          const PoseOnly& placed) {
  constexpr std::size_t kGroup = 15, kMinGroups = 6;
  std::vector<const Observation*> inliers;
  std::vector<Vector3> places;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (!placed.inlier[k] || (placed.pose * observations[k].point_m).z() < kMinDepth_m) continue;
    inliers.push_back(&observations[k]);
    places.push_back(observations[k].point_m);
  }
  const std::vector<std::size_t> groups = point_groups(places, kGroup);
  std::vector<Vector6> pulls(groups.empty() ? 0 : 1 + *std::max_element(groups.begin(), groups.end()), Vector6::Zero());
  if (pulls.size() < kMinGroups) return 1.0;
  Matrix6 information = Matrix6::Zero();
  for (std::size_t k = 0; k < inliers.size(); ++k) {
    const Eigen::Matrix<double, 3, 6> J = residual_jacobian(*inliers[k], camera, placed.pose);
    information += J.transpose() * J / inliers[k]->variance_px2;
    pulls[groups[k]] += J.transpose() * residual_of(*inliers[k], camera, placed.pose) / inliers[k]->variance_px2;
  }
  const Eigen::LDLT<Matrix6> factor(information);
  double sum = 0.0;
  for (const Vector6& pull : pulls) sum += pull.dot(factor.solve(pull)) / 6.0;
  const auto count = static_cast<double>(pulls.size());
  sum *= count / (count - 2.0);  // the pose follows the pulls: each group fixes three of its six coordinates
  return std::isfinite(sum) ? std::max(1.0, sum) : 1.0;
}

PoseOnly adjust_pose(const std::vector<Observation>& observations, const StereoCamera& camera,
                     const CameraFromTarget& start) {
  PoseOnly result;
  result.pose = start;
  result.inlier.assign(observations.size(), true);
  optimize::Descent<PoseDescent> d;
  for (int round = 0; round < kRounds; ++round) {
    optimize::descend(PoseDescent(observations, result.inlier, camera), result.pose, {kMaxIterations, kConverged}, d);
    result.pose = d.state;
    result.pose.R = orthonormalised(result.pose.R);
    result.inliers = 0;
    for (std::size_t k = 0; k < observations.size(); ++k) {
      const Observation& observation = observations[k];
      const bool ahead = (result.pose * observation.point_m).z() > kMinDepth_m;
      const double chi2 =
          ahead ? residual_of(observation, camera, result.pose).squaredNorm() / observation.variance_px2 : 1e9;
      result.inlier[k] = chi2 <= limit_of(observation);
      result.inliers += result.inlier[k] ? 1 : 0;
    }
    if (result.inliers < kMinPosePoints) break;
  }
  if (result.inliers < kMinPosePoints) return result;
  const Normal normal = PoseDescent(observations, result.inlier, camera).linearise(result.pose);
  const Matrix6 covariance = normal.matrix.ldlt().solve(Matrix6::Identity());
  if (covariance.allFinite()) result.covariance = covariance;
  result.rms_px = rms_of(observations, camera, result);
  return result;
}

}  // namespace pharos::slam
