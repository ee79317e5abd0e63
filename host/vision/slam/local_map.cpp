// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/local_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace pharos::slam {
namespace {

constexpr std::size_t kMaxKeyframes = 40;
constexpr std::size_t kNeighbours = 5;
constexpr double kCosFacing = 0.998;
constexpr double kFacingRadius_px = 2.5, kRadius_px = 4.0;

}  // namespace

LocalMap local_map(const Map& map, const Frame& frame) {
  std::map<KeyframeId, int> votes;
  for (const PointId id : frame.points) {
    const MapPoint* point = map.find_point(id);
    if (point == nullptr) continue;
    for (const auto& [keyframe, feature] : point->seen_by) ++votes[keyframe];
  }
  LocalMap out;
  std::set<KeyframeId> local;
  int maximum = 0;
  for (const auto& [id, count] : votes) {
    local.insert(id);
    if (count > maximum) {
      maximum = count;
      out.nearest = id;
    }
  }
  for (const auto& [id, count] : votes) {
    if (local.size() >= kMaxKeyframes) break;
    for (const KeyframeId other : map.best_neighbours(id, kNeighbours)) local.insert(other);
    const Keyframe& keyframe = map.keyframes.at(id);
    if (keyframe.parent != kNone) local.insert(keyframe.parent);
  }
  for (const KeyframeId id : local) {
    for (const PointId point : map.keyframes.at(id).points) {
      if (point != kNone) out.points.push_back(point);
    }
  }
  std::sort(out.points.begin(), out.points.end());
  out.points.erase(std::unique(out.points.begin(), out.points.end()), out.points.end());
  return out;
}

std::vector<Candidate> local_candidates(Map& map, const LocalMap& local, const Frame& frame, const StereoCamera& camera,
                                        const CameraFromTarget& pose, double widening) {
  std::vector<PointId> matched;
  for (const PointId id : frame.points) {
    if (id != kNone) matched.push_back(id);
  }
  std::sort(matched.begin(), matched.end());
  const Vector3 eye = pose.inverse().t;
  std::vector<Candidate> candidates;
  for (const PointId id : local.points) {
    MapPoint& point = map.points.at(id);
    const Vector3 p = pose * point.position_m;
    if (p.z() <= 0.0) continue;
    const Vector3 place = camera.project(p);
    if (!(place.x() >= 0.0 && place.x() < camera.width_px && place.y() >= 0.0 && place.y() < camera.height_px)) {
      continue;
    }
    const double distance_m = p.norm();
    if (distance_m < 0.8 * point.min_distance_m || distance_m > 1.2 * point.max_distance_m) continue;
    const double facing = (point.position_m - eye).dot(point.normal) / distance_m;
    if (facing < kCosMaxTurn) continue;
    ++point.visible;
    if (std::binary_search(matched.begin(), matched.end(), id)) continue;
    const int level = std::clamp(
        static_cast<int>(std::ceil(std::log(point.max_distance_m / distance_m) / std::log(kLevelScale) - 0.5)), 0,
        kLevels - 1);
    const double radius_px = (facing > kCosFacing ? kFacingRadius_px : kRadius_px) * widening;
    candidates.push_back({id, point.position_m, point.descriptor, level, radius_px, 0.0});
  }
  return candidates;
}

}  // namespace pharos::slam
