// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/rigid_fit.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "host/linear/dense.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::slam {
namespace {

constexpr int kMaxTrials = 300;
constexpr int kPolishSteps = 3;
constexpr double kSure = 0.999;
// Factor of the reprojection limits for RANSAC trials: depths of single features are coarse.
constexpr double kLoose = 4.0;

int inliers_of(const std::vector<Observation>& observations, const StereoCamera& camera, const CameraFromTarget& pose) {
  return static_cast<int>(std::count_if(observations.begin(), observations.end(), [&](const Observation& at) {
    return (pose * at.point_m).z() > kMinDepth_m &&
           residual_of(at, camera, pose).squaredNorm() / at.variance_px2 <= kLoose * kStereoChi2;
  }));
}

// Least squares of three observations: far points' depths are coarse, their directions are not.
CameraFromTarget polished(const std::vector<Observation>& three, const StereoCamera& camera, CameraFromTarget pose) {
  for (int step = 0; step < kPolishSteps; ++step) {
    Matrix6 H = Matrix6::Zero();
    Vector6 gradient = Vector6::Zero();
    for (const Observation& at : three) {
      if (!((pose * at.point_m).z() > kMinDepth_m)) return pose;
      const auto J = residual_jacobian(at, camera, pose);
      H += J.transpose() * J / at.variance_px2;
      gradient += J.transpose() * residual_of(at, camera, pose) / at.variance_px2;
    }
    const Vector6 move = solve_symmetric<6>(H, gradient);
    if (!move.allFinite()) return pose;
    pose = pose.moved_by(-move);
  }
  return pose;
}

int trials_for(double fraction) {
  const double hit = fraction * fraction * fraction;
  if (hit >= 1.0) return 1;
  return static_cast<int>(std::min<double>(kMaxTrials, std::ceil(std::log(1.0 - kSure) / std::log1p(-hit))));
}

}  // namespace

std::optional<CameraFromTarget> rigid_fit(const std::vector<Vector3>& points, const std::vector<Vector3>& seen) {
  if (points.size() < 3 || points.size() != seen.size()) return std::nullopt;
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    from += points[k];
    to += seen[k];
  }
  from /= static_cast<double>(points.size());
  to /= static_cast<double>(points.size());
  Matrix3 H = Matrix3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) H += (seen[k] - to) * (points[k] - from).transpose();
  const host::NearestRotation turn = host::nearest_rotation(H);
  if (!(turn.singular_values[1] > 1e-9 * turn.singular_values[0])) return std::nullopt;
  return CameraFromTarget{turn.R, to - turn.R * from};
}

std::optional<PoseOnly> robust_pose(const std::vector<Observation>& observations, const StereoCamera& camera,
                                    int min_inliers, std::uint64_t seed) {
  std::vector<std::size_t> stereo;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (observations[k].stereo()) stereo.push_back(k);
  }
  if (stereo.size() < 3 || static_cast<int>(observations.size()) < min_inliers) return std::nullopt;
  const auto seen_at = [&](const Observation& at) {
    return camera.back_project(at.pixel, camera.depth_m(at.pixel.x() - at.right_u_px));
  };
  std::mt19937_64 random(seed);
  CameraFromTarget best;
  int maximum = 0, trials = kMaxTrials;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Vector3> points, seen;
    std::vector<Observation> three;
    for (int k = 0; k < 3; ++k) {
      const Observation& at = observations[stereo[random() % stereo.size()]];
      three.push_back(at);
      points.push_back(at.point_m);
      seen.push_back(seen_at(at));
    }
    const auto coarse = rigid_fit(points, seen);
    if (!coarse) continue;
    const CameraFromTarget pose = polished(three, camera, *coarse);
    const int count = inliers_of(observations, camera, pose);
    if (count <= maximum) continue;
    maximum = count;
    best = pose;
    trials = std::min(trials, trials_for(static_cast<double>(count) / static_cast<double>(observations.size())));
  }
  if (maximum < std::max(3, min_inliers / 2)) return std::nullopt;
  PoseOnly refined = adjust_pose(observations, camera, best);
  if (refined.inliers < min_inliers) return std::nullopt;
  return refined;
}

}  // namespace pharos::slam
