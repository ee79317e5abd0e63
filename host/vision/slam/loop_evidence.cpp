// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/loop_evidence.hpp"

#include <cmath>
#include <random>

#include "host/vision/slam/patch_alignment.hpp"
#include "host/vision/slam/place_gate.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {
namespace {

constexpr std::size_t kSurroundings = 10;
constexpr std::size_t kNeighboursAsked = 3;
constexpr int kMinOffPlane = 10;  // a quarter of the inliers that a loop needs
constexpr int kPlanes = 100;      // trials: three of them are on a plane of three quarters in 42 % each
constexpr double kPlaneSigmas = 3.0;

// 1 sigma of the depth by stereo at a feature.
double depth_sigma_m(const Feature& feature, double depth_m, const StereoCamera& camera) {
  const double disparity_px = kDisparityFraction * std::sqrt(feature.corner_variance_px2());
  return depth_m * depth_m * disparity_px / (camera.fx_px * camera.baseline_m);
}

// Moves the pose to that of the aligned patches; where a place was found as corners, its inliers stay those.
void align_place(Frame& frame, const Map& map, const StereoCamera& camera, const std::vector<PyramidLevel>& pyramid,
                 PlaceFit& out) {
  if (pyramid.empty() || out.pose.inliers < kMinAgreed) return;
  align_with_patches(frame, map, camera, out.pose.pose, pyramid);
  const PoseOnly placed = place_frame(frame, map, camera, out.pose.pose);
  if (placed.inliers < kMinAgreed) return;
  out.pose.pose = placed.pose;
  out.pose.covariance = placed.covariance;
  out.pose.rms_px = placed.rms_px;
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    if (frame.points[k] != kNone && !frame.features[k].is_corner()) {
      out.aligned.emplace_back(frame.points[k], frame.features[k]);
    }
  }
}

}  // namespace

Observation corner_of(const Feature& feature, const Vector3& point_m) {
  Observation at = observation_of(feature, point_m);
  at.variance_px2 = feature.corner_variance_px2();
  return at;
}

std::set<PointId> points_around(const Map& map, KeyframeId id) {
  std::vector<KeyframeId> around = map.best_neighbours(id, kSurroundings);
  around.push_back(id);
  std::set<PointId> points;
  for (const KeyframeId near : around) {
    for (const PointId point : map.keyframes.at(near).points) {
      if (point != kNone) points.insert(point);
    }
  }
  return points;
}

PlaceFit fit_place(const Map& map, const Keyframe& keyframe, const CameraFromTarget& start, KeyframeId there,
                   const StereoCamera& camera, const std::vector<PyramidLevel>& pyramid) {
  std::vector<Candidate> candidates;
  for (const PointId id : points_around(map, there)) {
    const MapPoint& point = map.points.at(id);
    candidates.push_back({id, point.position_m, point.descriptor, point.level, kLoopRadius_px, 0.0});
  }
  Frame frame = keyframe;
  frame.points.assign(frame.features.size(), kNone);
  for (Feature& feature : frame.features) feature.sigma_px = kCornerSigma_px;
  for (const ProjectionMatch& match :
       match_by_projection(candidates, keyframe, {}, camera, start, {kHighDistanceThreshold, 0.9, false})) {
    frame.points[static_cast<std::size_t>(match.feature)] = candidates[static_cast<std::size_t>(match.candidate)].point;
  }
  PlaceFit out{place_frame(frame, map, camera, start), {}, {}};
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    if (frame.points[k] != kNone) out.seen.emplace_back(static_cast<int>(k), frame.points[k]);
  }
  align_place(frame, map, camera, pyramid, out);
  return out;
}

Matrix6 covariance_of(const PlaceFit& place, const Map& map, const Keyframe& keyframe, const StereoCamera& camera) {
  return in_target_axes(place.pose.pose, place.pose.covariance) + error_of_a_link(map, keyframe, camera);
}

bool on_one_plane(const Map& map, const std::vector<std::pair<int, PointId>>& seen, const Keyframe& keyframe,
                  const StereoCamera& camera) {
  std::vector<Vector3> points;
  std::vector<double> limits_m;
  for (const auto& [feature, id] : seen) {
    const Vector3& at = map.points.at(id).position_m;
    points.push_back(at);
    limits_m.push_back(kPlaneSigmas * depth_sigma_m(keyframe.features[static_cast<std::size_t>(feature)],
                                                    (keyframe.pose * at).z(), camera));
  }
  if (points.size() < 3) return true;
  std::mt19937_64 random(static_cast<std::uint64_t>(keyframe.id));
  for (int trial = 0; trial < kPlanes; ++trial) {
    const Vector3& a = points[random() % points.size()];
    const Vector3& b = points[random() % points.size()];
    const Vector3& c = points[random() % points.size()];
    const Vector3 normal = (b - a).cross(c - a);
    if (!(normal.norm() > 0.0)) continue;
    int off = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      off += std::abs(normal.normalized().dot(points[k] - a)) > limits_m[k] ? 1 : 0;
    }
    if (off < kMinOffPlane) return true;
  }
  return false;
}

bool neighbours_agree(const Map& map, const Keyframe& here, const CameraFromTarget& corrected, KeyframeId there,
                      const StereoCamera& camera) {
  const std::vector<KeyframeId> neighbours = map.best_neighbours(here.id, kNeighboursAsked);
  std::size_t agreed = 0;
  for (const KeyframeId id : neighbours) {
    const Keyframe& near = map.keyframes.at(id);
    const CameraFromTarget expected = near.pose * here.pose.inverse() * corrected;
    const PlaceFit found = fit_place(map, near, expected, there, camera);
    agreed += found.pose.inliers >= kMinAgreed ? 1 : 0;
  }
  return 2 * agreed >= neighbours.size();
}

}  // namespace pharos::slam
