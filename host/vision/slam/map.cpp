// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace pharos::slam {

Keyframe& Map::add_keyframe(const Frame& frame, WordVector words) {
  const KeyframeId id = next_keyframe_++;
  Keyframe& keyframe = keyframes[id];
  static_cast<Frame&>(keyframe) = frame;
  keyframe.id = id;
  keyframe.words = std::move(words);
  std::vector<PointId> seen(keyframe.features.size(), kNone);
  seen.swap(keyframe.points);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    keyframe.features[k].sigma_px = kCornerSigma_px;
    if (!points.contains(seen[k])) continue;
    observe(seen[k], id, static_cast<int>(k));
    keyframe.features[k].sigma_px = frame.features[k].sigma_px;
  }
  return keyframe;
}

MapPoint& Map::add_point(const Vector3& position_m, KeyframeId keyframe, int feature) {
  const PointId id = next_point_++;
  MapPoint& point = points[id];
  point.id = id;
  point.position_m = position_m;
  point.created_at = newest();
  observe(id, keyframe, feature);
  refresh(id);
  return point;
}

void Map::observe(PointId point, KeyframeId keyframe, int feature) {
  Keyframe& frame = keyframes.at(keyframe);
  PointId& slot = frame.points[static_cast<std::size_t>(feature)];
  if (slot != kNone || !points.at(point).seen_by.emplace(keyframe, feature).second) return;
  slot = point;
  frame.features[static_cast<std::size_t>(feature)].sigma_px = kCornerSigma_px;
}

void Map::forget_observation(PointId point, KeyframeId keyframe) {
  MapPoint& seen = points.at(point);
  const auto at = seen.seen_by.find(keyframe);
  if (at == seen.seen_by.end()) return;
  keyframes.at(keyframe).points[static_cast<std::size_t>(at->second)] = kNone;
  seen.seen_by.erase(at);
  if (seen.seen_by.empty()) points.erase(point);
}

void Map::remove_point(PointId point) {
  const auto at = points.find(point);
  if (at == points.end()) return;
  for (const auto& [keyframe, feature] : at->second.seen_by) {
    keyframes.at(keyframe).points[static_cast<std::size_t>(feature)] = kNone;
  }
  points.erase(at);
}

void Map::fuse(PointId from, PointId into) {
  if (from == into || !points.contains(from) || !points.contains(into)) return;
  const MapPoint old = points.at(from);
  remove_point(from);
  MapPoint& kept = points.at(into);
  for (const auto& [keyframe, feature] : old.seen_by) observe(into, keyframe, feature);
  kept.visible += old.visible;
  kept.found += old.found;
  refresh(into);
}

void Map::reparent(Keyframe& orphan, KeyframeId removed, KeyframeId grandparent) {
  // The covisible keyframe that shares most points and is older (so that there is no cycle); else the grandparent.
  KeyframeId best = grandparent;
  int maximum = 0;
  for (const auto& [id, shared] : orphan.neighbours) {
    if (id < orphan.id && id != removed && shared > maximum && keyframes.contains(id)) {
      best = id;
      maximum = shared;
    }
  }
  orphan.parent = best;
  if (best != kNone) keyframes.at(best).children.insert(orphan.id);
}

namespace {

// Covariances along a path from the first keyframe add; whichever of the two lies farther has the larger one.
Matrix6 covariance_between(const Matrix6& a, const Matrix6& b) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> difference(a - b);
  if (difference.info() != Eigen::Success) return a + b;
  return difference.eigenvectors() * difference.eigenvalues().cwiseAbs().asDiagonal() *
         difference.eigenvectors().transpose();
}

}  // namespace

void Map::remove_keyframe(KeyframeId id) {
  const auto at = keyframes.find(id);
  if (at == keyframes.end() || at->second.parent == kNone) return;
  Keyframe& gone = at->second;
  const Keyframe& parent = keyframes.at(gone.parent);
  removed_[id] = {gone.parent, gone.pose * parent.pose.inverse(),
                  covariance_between(gone.covariance, parent.covariance)};
  const std::vector<PointId> seen = gone.points;
  for (const PointId point : seen) {
    if (point != kNone) forget_observation(point, id);
  }
  for (const auto& [other, shared] : gone.neighbours) {
    if (const auto found = keyframes.find(other); found != keyframes.end()) found->second.neighbours.erase(id);
  }
  keyframes.at(gone.parent).children.erase(id);
  for (const KeyframeId child : gone.children) reparent(keyframes.at(child), id, gone.parent);
  keyframes.erase(at);
}

void Map::update_neighbours(KeyframeId id) {
  Keyframe& keyframe = keyframes.at(id);
  std::map<KeyframeId, int> shared;
  for (const PointId point : keyframe.points) {
    if (point == kNone) continue;
    for (const auto& [other, feature] : points.at(point).seen_by) {
      if (other != id) ++shared[other];
    }
  }
  for (const auto& [other, count] : keyframe.neighbours) {
    if (const auto found = keyframes.find(other); found != keyframes.end()) found->second.neighbours.erase(id);
  }
  keyframe.neighbours.clear();
  KeyframeId best = kNone;
  for (const auto& [other, count] : shared) {
    if (best == kNone || count > shared.at(best)) best = other;
  }
  for (const auto& [other, count] : shared) {
    if (count < kCovisible && other != best) continue;
    keyframe.neighbours[other] = count;
    keyframes.at(other).neighbours[id] = count;
  }
  if (keyframe.parent == kNone && id != keyframes.begin()->first && best != kNone && best < id) {
    keyframe.parent = best;
    keyframes.at(best).children.insert(id);
  }
}

void Map::refresh(PointId id) {
  MapPoint& point = points.at(id);
  std::vector<const Descriptor*> seen;
  Vector3 sum = Vector3::Zero();
  for (const auto& [keyframe, feature] : point.seen_by) {
    const Keyframe& frame = keyframes.at(keyframe);
    seen.push_back(&frame.features[static_cast<std::size_t>(feature)].descriptor);
    const Vector3 eye = frame.pose.inverse().t;
    sum += (point.position_m - eye).normalized();
  }
  if (seen.empty()) return;
  // Smallest median distance to the others.
  int minimum = std::numeric_limits<int>::max();
  std::vector<int> distances(seen.size());
  for (const Descriptor* candidate : seen) {
    for (std::size_t k = 0; k < seen.size(); ++k) distances[k] = distance(*candidate, *seen[k]);
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < minimum) {
      minimum = *middle;
      point.descriptor = *candidate;
    }
  }
  if (sum.norm() > 0.0) point.normal = sum.normalized();
  const auto& [keyframe, feature] = *point.seen_by.rbegin();
  const Keyframe& latest = keyframes.at(keyframe);
  point.level = latest.features[static_cast<std::size_t>(feature)].level;
  const double distance_m = (latest.pose * point.position_m).norm();
  point.max_distance_m = distance_m * scale_of(point.level);
  point.min_distance_m = point.max_distance_m / scale_of(kLevels - 1);
}

std::vector<KeyframeId> Map::best_neighbours(KeyframeId id, std::size_t count) const {
  std::vector<std::pair<int, KeyframeId>> sorted;
  for (const auto& [other, shared] : keyframes.at(id).neighbours) sorted.emplace_back(-shared, other);
  std::sort(sorted.begin(), sorted.end());
  std::vector<KeyframeId> best;
  for (const auto& [shared, other] : sorted) {
    if (best.size() == count) break;
    best.push_back(other);
  }
  return best;
}

CameraFromTarget Map::pose_of(KeyframeId id) const {
  Pose<frame::Camera, frame::Camera> chain;
  for (auto at = removed_.find(id); at != removed_.end(); at = removed_.find(id)) {
    chain = chain * at->second.T_this_parent;
    id = at->second.parent;
  }
  return chain * keyframes.at(id).pose;
}

Matrix6 Map::covariance_of(KeyframeId id) const {
  Matrix6 between = Matrix6::Zero();
  for (auto at = removed_.find(id); at != removed_.end(); at = removed_.find(id)) {
    between += at->second.between;
    id = at->second.parent;
  }
  return keyframes.at(id).covariance + between;
}

void Map::forget_removed(KeyframeId kept) {
  std::set<KeyframeId> referenced;
  const auto keep = [&](KeyframeId id) {
    for (auto at = removed_.find(id); at != removed_.end() && referenced.insert(id).second; at = removed_.find(id)) {
      id = at->second.parent;
    }
  };
  keep(kept);
  for (const auto& [id, point] : points) {
    if (point.patch) keep(point.patch->keyframe);
  }
  std::erase_if(removed_, [&referenced](const auto& entry) { return !referenced.contains(entry.first); });
}

int Map::tracked_points(const Keyframe& keyframe, std::size_t observers) const {
  int count = 0;
  for (const PointId point : keyframe.points) {
    if (point != kNone && points.at(point).seen_by.size() >= observers) ++count;
  }
  return count;
}

const MapPoint* Map::find_point(PointId point) const {
  const auto at = points.find(point);
  return at == points.end() ? nullptr : &at->second;
}

}  // namespace pharos::slam
