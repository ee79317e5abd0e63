// SPDX-License-Identifier: Apache-2.0
// Triangulates points from rays of two keyframes.
#include <algorithm>
#include <cmath>

#include "host/vision/slam/mapping.hpp"
#include "host/vision/slam/pose_only.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {
namespace {

constexpr std::size_t kTriangulateWith = 10;
constexpr double kCosMinParallax = 0.99985;  // 1 deg

bool fits(const Feature& feature, const Vector3& point_m, const StereoCamera& camera, const CameraFromTarget& pose) {
  if (!((pose * point_m).z() > kMinDepth_m)) return false;
  const Observation at = observation_of(feature, point_m);
  return residual_of(at, camera, pose).squaredNorm() / at.variance_px2 <= (at.stereo() ? kStereoChi2 : kMonoChi2);
}

std::vector<bool> pointless(const Keyframe& keyframe) {
  std::vector<bool> free(keyframe.points.size());
  for (std::size_t k = 0; k < free.size(); ++k) free[k] = keyframe.points[k] == kNone;
  return free;
}

// Point of two features: intersection of their rays, or the nearer one's stereo depth where the parallax is too small.
bool place_of(const Keyframe& a, const Feature& in_a, const Keyframe& b, const Feature& in_b,
              const StereoCamera& camera, Vector3& point) {
  const auto T_target_a = a.pose.inverse(), T_target_b = b.pose.inverse();
  const Vector3 ray_a = T_target_a.R * camera.back_project(in_a.pixel, 1.0);
  const Vector3 ray_b = T_target_b.R * camera.back_project(in_b.pixel, 1.0);
  const double cosine = ray_a.normalized().dot(ray_b.normalized());
  if (cosine < kCosMinParallax) {
    // Midpoint of the shortest line between the rays.
    const Vector3 between = T_target_b.t - T_target_a.t;
    const double aa = ray_a.dot(ray_a), bb = ray_b.dot(ray_b), ab = ray_a.dot(ray_b);
    const double determinant = aa * bb - ab * ab;
    const double along_a = (bb * ray_a.dot(between) - ab * ray_b.dot(between)) / determinant;
    const double along_b = (ab * ray_a.dot(between) - aa * ray_b.dot(between)) / determinant;
    point = 0.5 * (T_target_a.t + along_a * ray_a + T_target_b.t + along_b * ray_b);
    return along_a > 0.0 && along_b > 0.0;
  }
  if (in_a.stereo()) {
    point = T_target_a * camera.back_project(in_a.pixel, in_a.depth_m);
    return true;
  }
  if (in_b.stereo()) point = T_target_b * camera.back_project(in_b.pixel, in_b.depth_m);
  return in_b.stereo();
}

// Distance of b's feature from the epipolar line of a's feature, px.
double off_line(const Keyframe& a, const Feature& in_a, const Keyframe& b, const Feature& in_b,
                const StereoCamera& camera) {
  const Pose<frame::Camera, frame::Camera> T_b_a = b.pose * a.pose.inverse();
  const Vector3 normal = T_b_a.t.cross(T_b_a.R * camera.back_project(in_a.pixel, 1.0));
  const Vector2 gradient(normal.x() / camera.fx_px, normal.y() / camera.fy_px);
  return std::abs(normal.dot(camera.back_project(in_b.pixel, 1.0))) / std::max(1e-12, gradient.norm());
}

int triangulate_pair(Map& map, KeyframeId a_id, KeyframeId b_id, const StereoCamera& camera) {
  const Keyframe &a = map.keyframes.at(a_id), &b = map.keyframes.at(b_id);
  if ((a.pose.inverse().t - b.pose.inverse().t).norm() < 0.5 * camera.baseline_m) return 0;
  const auto matches = match_by_descriptor(a.features, pointless(a), b.features, pointless(b), 0.8);
  int added = 0;
  for (const ProjectionMatch& match : matches) {
    const Feature& in_a = a.features[static_cast<std::size_t>(match.candidate)];
    const Feature& in_b = b.features[static_cast<std::size_t>(match.feature)];
    Vector3 point;
    if (match.distance > kLowDistanceThreshold || off_line(a, in_a, b, in_b, camera) > 2.0 * scale_of(in_b.level) ||
        !place_of(a, in_a, b, in_b, camera, point) || !fits(in_a, point, camera, a.pose) ||
        !fits(in_b, point, camera, b.pose)) {
      continue;
    }
    const PointId id = map.add_point(point, a_id, match.candidate).id;
    map.observe(id, b_id, match.feature);
    map.refresh(id);
    ++added;
  }
  return added;
}

}  // namespace

int triangulate(Map& map, KeyframeId keyframe, const StereoCamera& camera) {
  int added = 0;
  for (const KeyframeId other : map.best_neighbours(keyframe, kTriangulateWith)) {
    added += triangulate_pair(map, keyframe, other, camera);
  }
  return added;
}

}  // namespace pharos::slam
