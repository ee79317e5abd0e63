// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/direct_search.hpp"

#include <algorithm>

#include "host/vision/slam/patch_alignment.hpp"

namespace pharos::slam {
namespace {

constexpr double kSameCorner_px = 1.5;  // of its level
constexpr double kCosSameSide = 0.7;    // 45 deg between the views

// The nearest corner without a point.
int free_corner(const Frame& frame, const Vector2& pixel, int level, std::vector<int>& near) {
  const double radius_px = kSameCorner_px * scale_of(level);
  frame.grid.near(frame.features, pixel, radius_px, level - 1, level + 1, near);
  int best = -1;
  double least = radius_px;
  for (const int k : near) {
    if (frame.points[static_cast<std::size_t>(k)] != kNone) continue;
    const double off = (frame.features[static_cast<std::size_t>(k)].pixel - pixel).norm();
    if (off < least) {
      least = off;
      best = k;
    }
  }
  return best;
}

}  // namespace

int search_patches(Frame& frame, const Map& map, const std::vector<Candidate>& candidates, const StereoCamera& camera,
                   const CameraFromTarget& pose, const std::vector<PyramidLevel>& pyramid) {
  if (pyramid.empty()) return 0;
  std::vector<PointId> matched;
  for (const PointId id : frame.points) {
    if (id != kNone) matched.push_back(id);
  }
  std::sort(matched.begin(), matched.end());
  int added = 0;
  std::vector<int> near;
  for (const Candidate& candidate : candidates) {
    const MapPoint& point = map.points.at(candidate.point);
    if (!point.patch || std::binary_search(matched.begin(), matched.end(), candidate.point)) continue;
    const CameraFromTarget from = map.pose_of(point.patch->keyframe);
    const Vector3 p = pose * point.position_m;
    if (!(p.z() > 0.0)) continue;
    const Vector3 sight = point.position_m - pose.inverse().t, first = point.position_m - from.inverse().t;
    if (sight.dot(first) < kCosSameSide * sight.norm() * first.norm()) continue;
    Feature own;
    own.pixel = camera.project(p).head<2>();
    own.level = candidate.level;
    own.descriptor = candidate.descriptor;
    own.direct = true;
    const int corner = free_corner(frame, own.pixel, own.level, near);
    if (corner >= 0) own.level = frame.features[static_cast<std::size_t>(corner)].level;
    const auto found = find_patch(*point.patch, pose * from.inverse(), camera, own, pyramid);
    if (!found || (found->pixel - own.pixel).norm() > kSameCorner_px * scale_of(own.level)) continue;
    if (corner >= 0) {
      move_to_patch(frame.features[static_cast<std::size_t>(corner)], *found, camera);
      frame.points[static_cast<std::size_t>(corner)] = candidate.point;
    } else {
      move_to_patch(own, *found, camera);
      frame.features.push_back(own);
      frame.points.push_back(candidate.point);
    }
    ++added;
  }
  return added;
}

}  // namespace pharos::slam
