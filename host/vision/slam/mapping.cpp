// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/mapping.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {
namespace {

constexpr std::size_t kMinPoints = 100;
constexpr std::size_t kFuseWith = 20, kFuseWithTheirs = 5;
constexpr double kFuseRadius_px = 3.0;
constexpr double kMinFoundFraction = 0.25;
constexpr std::size_t kMinObservers = 3;
// ORB-SLAM's is 0.9. A corner is measured to half a pixel in each keyframe: removing keyframes reduces accuracy (90 deg
// in good light: RMSE 0.125 deg with 0.9, 0.091 with this).
constexpr double kRedundantFraction = 0.98;

// With a limit of keyframes: as many of the newest stay, by which the next pair is tracked.
constexpr std::size_t kNewestKept = 5;

// How many of the keyframe's points three others observe at least as well; 0 without points.
double fraction_seen_elsewhere(const Map& map, const Keyframe& keyframe) {
  int near = 0, elsewhere = 0;
  for (std::size_t k = 0; k < keyframe.points.size(); ++k) {
    if (keyframe.points[k] == kNone) continue;
    const MapPoint& point = map.points.at(keyframe.points[k]);
    ++near;
    if (point.seen_by.size() <= kMinObservers) continue;
    std::size_t as_good = 0;
    for (const auto& [other, feature] : point.seen_by) {
      if (other == keyframe.id) continue;
      const Feature& there = map.keyframes.at(other).features[static_cast<std::size_t>(feature)];
      as_good += there.level <= keyframe.features[k].level + 1 ? 1U : 0U;
    }
    elsewhere += as_good >= kMinObservers ? 1 : 0;
  }
  return near > 0 ? static_cast<double>(elsewhere) / near : 0.0;
}

bool removable(const Keyframe& keyframe) { return keyframe.parent != kNone && keyframe.loops.empty(); }

// The one without which the map loses least: those that stay are spread over what was seen. Of equals the oldest.
// Rejected: always the oldest but the first, whose window is then bound to the first by the few points that both see,
// from directions 120 deg apart: 0.59 deg RMSE over 180 deg with sigmas 38 times too small, instead of 0.058 deg.
KeyframeId expendable_keyframe(const Map& map, std::size_t newest_kept) {
  KeyframeId best = kNone;
  double most = -1.0;
  std::size_t left = map.keyframes.size();
  for (const auto& [id, keyframe] : map.keyframes) {
    if (left-- <= newest_kept) break;
    if (!removable(keyframe)) continue;
    if (const double fraction = fraction_seen_elsewhere(map, keyframe); fraction > most) {
      most = fraction;
      best = id;
    }
  }
  return best;
}

}  // namespace

void add_stereo_points(Map& map, KeyframeId id, const StereoCamera& camera) {
  const Keyframe& keyframe = map.keyframes.at(id);
  std::vector<std::pair<double, int>> by_depth;
  for (std::size_t k = 0; k < keyframe.features.size(); ++k) {
    if (keyframe.features[k].stereo()) by_depth.emplace_back(keyframe.features[k].depth_m, static_cast<int>(k));
  }
  std::sort(by_depth.begin(), by_depth.end());
  const auto T_target_camera = keyframe.pose.inverse();
  for (std::size_t k = 0; k < by_depth.size(); ++k) {
    const auto [depth_m, index] = by_depth[k];
    if (depth_m > kNearBaselines * camera.baseline_m && k >= kMinPoints) break;
    const auto at = static_cast<std::size_t>(index);
    if (keyframe.points[at] != kNone) continue;
    map.add_point(T_target_camera * camera.back_project(keyframe.features[at].pixel, depth_m), id, index);
  }
}

void add_patches(Map& map, KeyframeId id, const std::vector<PyramidLevel>& pyramid) {
  Keyframe& keyframe = map.keyframes.at(id);
  for (std::size_t k = 0; k < keyframe.points.size(); ++k) {
    if (keyframe.points[k] == kNone) continue;
    MapPoint& point = map.points.at(keyframe.points[k]);
    if (point.patch) continue;
    point.patch = cut_patch(id, keyframe.features[k], pyramid);
    if (point.patch) keyframe.features[k].sigma_px = kPatchSigma_px;
  }
}

int fuse_points(Map& map, const std::vector<PointId>& points, KeyframeId into, const StereoCamera& camera,
                double radius_px) {
  const Keyframe& keyframe = map.keyframes.at(into);
  const Vector3 eye = keyframe.pose.inverse().t;
  std::vector<Candidate> candidates;
  for (const PointId id : points) {
    const MapPoint* point = map.find_point(id);
    if (point == nullptr || point->seen_by.contains(into)) continue;
    const Vector3 sight = point->position_m - eye;
    const double distance_m = sight.norm();
    if (distance_m < 0.8 * point->min_distance_m || distance_m > 1.2 * point->max_distance_m ||
        sight.dot(point->normal) < 0.5 * distance_m) {
      continue;
    }
    const double level = std::log(point->max_distance_m / distance_m) / std::log(kLevelScale);
    candidates.push_back({id, point->position_m, point->descriptor,
                          std::clamp(static_cast<int>(std::lround(level)), 0, kLevels - 1), radius_px, 0.0});
  }
  int fused = 0;
  for (const ProjectionMatch& match :
       match_by_projection(candidates, keyframe, {}, camera, keyframe.pose, {kLowDistanceThreshold, 1.0, false})) {
    const PointId id = candidates[static_cast<std::size_t>(match.candidate)].point;
    const PointId there = keyframe.points[static_cast<std::size_t>(match.feature)];
    if (!map.points.contains(id)) continue;
    ++fused;
    if (there == kNone) {
      map.observe(id, into, match.feature);
    } else if (map.points.at(there).seen_by.size() > map.points.at(id).seen_by.size()) {
      map.fuse(id, there);
    } else {
      map.fuse(there, id);
    }
  }
  return fused;
}

void fuse_with_neighbours(Map& map, KeyframeId id, const StereoCamera& camera) {
  std::set<KeyframeId> around;
  for (const KeyframeId near : map.best_neighbours(id, kFuseWith)) {
    around.insert(near);
    for (const KeyframeId other : map.best_neighbours(near, kFuseWithTheirs)) around.insert(other);
  }
  around.erase(id);
  const auto points_of = [&map](KeyframeId of) {
    std::vector<PointId> points;
    for (const PointId point : map.keyframes.at(of).points) {
      if (point != kNone) points.push_back(point);
    }
    return points;
  };
  const std::vector<PointId> own = points_of(id);
  for (const KeyframeId other : around) fuse_points(map, own, other, camera, kFuseRadius_px);
  std::set<PointId> neighbour_points;
  for (const KeyframeId other : around) {
    for (const PointId point : points_of(other)) neighbour_points.insert(point);
  }
  fuse_points(map, {neighbour_points.begin(), neighbour_points.end()}, id, camera, kFuseRadius_px);
  for (const PointId point : points_of(id)) map.refresh(point);
  map.update_neighbours(id);
}

void cull_points(Map& map, std::vector<PointId>& recent) {
  std::vector<PointId> kept;
  for (const PointId id : recent) {
    const MapPoint* point = map.find_point(id);
    if (point == nullptr) continue;
    const KeyframeId age = map.newest() - point->created_at;
    const bool missed = static_cast<double>(point->found) < kMinFoundFraction * static_cast<double>(point->visible);
    if (missed || (age >= 3 && point->seen_by.size() < kMinObservers)) {
      map.remove_point(id);
    } else if (age < 4) {
      kept.push_back(id);
    }
  }
  recent = std::move(kept);
}

int cull_keyframes(Map& map, KeyframeId id, KeyframeDatabase* keyframe_database, std::size_t maximum) {
  int removed = 0;
  const auto remove = [&](KeyframeId gone) {
    const Keyframe& keyframe = map.keyframes.at(gone);
    if (!removable(keyframe)) return;
    if (keyframe_database != nullptr) keyframe_database->remove(keyframe);
    map.remove_keyframe(gone);
    ++removed;
  };
  const auto around = map.best_neighbours(id, map.keyframes.size());
  for (const KeyframeId near : around) {
    if (fraction_seen_elsewhere(map, map.keyframes.at(near)) > kRedundantFraction) remove(near);
  }
  while (maximum > 0 && map.keyframes.size() > maximum) {
    const KeyframeId gone = expendable_keyframe(map, std::min(kNewestKept, maximum / 2));
    if (gone == kNone) break;
    remove(gone);
  }
  return removed;
}

}  // namespace pharos::slam
