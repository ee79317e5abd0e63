// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/loop_closing.hpp"

#include <algorithm>

#include "host/vision/slam/loop_evidence.hpp"
#include "host/vision/slam/mapping.hpp"
#include "host/vision/slam/place_gate.hpp"
#include "host/vision/slam/projection_match.hpp"
#include "host/vision/slam/rigid_fit.hpp"

namespace pharos::slam {
namespace {

constexpr KeyframeId kMinApart = 10;  // keyframes since the start and since the last loop
constexpr std::size_t kMaxLoopCandidates = 3;
constexpr int kMinDescriptorMatches = 20, kMinInliers = 40;
constexpr int kStrong = 100;  // shared points of an edge of the essential graph

void move_points(Map& map, const std::map<KeyframeId, CameraFromTarget>& before, const std::set<PointId>& but) {
  for (auto& [id, point] : map.points) {
    if (but.contains(id)) continue;
    const KeyframeId viewer = point.seen_by.begin()->first;
    const auto old = before.find(viewer);
    if (old == before.end()) continue;
    point.position_m = map.keyframes.at(viewer).pose.inverse() * (old->second * point.position_m);
  }
}

}  // namespace

std::optional<Loop> LoopCloser::find(KeyframeId id) {
  if (!map_.keyframes.contains(id) || id < kMinApart || (closed_at_ != kNone && id < closed_at_ + kMinApart)) {
    return std::nullopt;
  }
  const Keyframe& here = map_.keyframes.at(id);
  std::set<KeyframeId> connected{id};
  for (const auto& [near, shared] : here.neighbours) {
    connected.insert(near);
    for (const auto& [other, also] : map_.keyframes.at(near).neighbours) connected.insert(other);
  }
  const auto candidates = keyframe_database_.detect_candidates(here.words, map_, connected);
  std::optional<Loop> found;
  bool rival = false;
  for (std::size_t k = 0; k < std::min(candidates.size(), kMaxLoopCandidates); ++k) {
    auto loop = check(here, candidates[k].keyframe);
    if (!loop) continue;
    if (!found) {
      found = std::move(loop);
    } else if (contradicts(
                   place_offset(loop->corrected, found->corrected),
                   found->covariance + loop->covariance + drift_between(map_, found->there, loop->there, camera_))) {
      rival = true;
    }
  }
  if (found && rival) {
    counts_.rival += 1;
    found.reset();
  }
  refused_ += candidates.empty() || found ? 0 : 1;
  return found;
}

LoopDecision LoopCloser::decide(KeyframeId id) {
  LoopDecision out;
  if (!provisional_) {
    if (auto loop = find(id)) provisional_.emplace(std::move(*loop));
    return out;
  }
  const ProvisionalLoop::Verdict verdict = provisional_->hear(map_, id, camera_);
  if (verdict == ProvisionalLoop::Verdict::kConfirmed) out.close = provisional_->loop();
  if (verdict == ProvisionalLoop::Verdict::kContradicted) {
    out.taken_back = provisional_->loop();
    ++counts_.taken_back;
  }
  if (verdict != ProvisionalLoop::Verdict::kOpen) provisional_.reset();
  return out;
}

std::optional<Loop> LoopCloser::check(const Keyframe& here, KeyframeId candidate) {
  ++counts_.candidates;
  std::optional<Loop> loop = fit(here, candidate);
  int* refused = nullptr;
  if (!loop) {
    refused = &counts_.geometry;
  } else if (contradicts(place_offset(loop->corrected, here.pose),
                         drift_between(map_, here.id, candidate, camera_) + loop->covariance)) {
    refused = &counts_.trajectory;
  } else if (on_one_plane(map_, loop->seen, here, camera_)) {
    refused = &counts_.one_surface;
  } else if (!neighbours_agree(map_, here, loop->corrected, candidate, camera_)) {
    refused = &counts_.neighbours;
  }
  if (refused == nullptr) return loop;
  ++*refused;
  return std::nullopt;
}

std::optional<Loop> LoopCloser::fit(const Keyframe& here, KeyframeId candidate) const {
  const Keyframe& there = map_.keyframes.at(candidate);
  std::vector<bool> known(there.points.size());
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = there.points[k] != kNone;
  std::vector<Observation> observations;
  for (const ProjectionMatch& match : match_by_descriptor(there.features, known, here.features, {}, 0.85)) {
    const PointId point = there.points[static_cast<std::size_t>(match.candidate)];
    observations.push_back(
        corner_of(here.features[static_cast<std::size_t>(match.feature)], map_.points.at(point).position_m));
  }
  const auto placed = robust_pose(observations, camera_, kMinDescriptorMatches, static_cast<std::uint64_t>(here.id));
  if (!placed) return std::nullopt;
  const PlaceFit refined = fit_place(map_, here, placed->pose, candidate, camera_);
  if (refined.pose.inliers < kMinInliers) return std::nullopt;
  return Loop{here.id, candidate, refined.pose.pose, in_target_axes(refined.pose.pose, refined.pose.covariance),
              refined.seen};
}

void LoopCloser::move_side(const Loop& loop, const std::vector<KeyframeId>& side) {
  const CameraFromTarget old_here = map_.keyframes.at(loop.here).pose;
  const Pose<frame::Target, frame::Target> shift = loop.corrected.inverse() * old_here;
  const std::set<PointId> kept = points_around(map_, loop.there);
  std::set<PointId> moving;
  for (const KeyframeId id : side) {
    for (const PointId point : map_.keyframes.at(id).points) {
      if (point != kNone && !kept.contains(point)) moving.insert(point);
    }
  }
  for (const PointId id : moving) {
    Vector3& position = map_.points.at(id).position_m;
    position = shift * position;
  }
  for (const KeyframeId id : side) {
    CameraFromTarget& pose = map_.keyframes.at(id).pose;
    pose = (pose * old_here.inverse()) * loop.corrected;
  }
}

std::vector<PoseEdge> LoopCloser::essential_edges(const std::map<KeyframeId, CameraFromTarget>& before) const {
  std::vector<PoseEdge> edges;
  for (const auto& [id, keyframe] : map_.keyframes) {
    std::set<KeyframeId> to;
    if (keyframe.parent != kNone) to.insert(keyframe.parent);
    for (const auto& [other, shared] : keyframe.neighbours) {
      if (other < id && shared >= kStrong) to.insert(other);
    }
    for (const KeyframeId other : to) {
      edges.push_back({id, other, before.at(id) * before.at(other).inverse()});
    }
    for (const auto& [other, measured] : keyframe.loops) {
      if (other < id && map_.keyframes.contains(other)) edges.push_back({id, other, measured});
    }
  }
  return edges;
}

void LoopCloser::correct(const Loop& loop) {
  std::map<KeyframeId, CameraFromTarget> before;
  for (const auto& [id, keyframe] : map_.keyframes) before[id] = keyframe.pose;
  // Edges of the state before duplicate points are fused between the two sides.
  std::vector<PoseEdge> edges = essential_edges(before);
  std::vector<KeyframeId> side = map_.best_neighbours(loop.here, map_.keyframes.size());
  side.push_back(loop.here);
  move_side(loop, side);
  for (const auto& [feature, point] : loop.seen) {
    if (!map_.points.contains(point)) continue;
    const PointId own = map_.keyframes.at(loop.here).points[static_cast<std::size_t>(feature)];
    if (own == kNone) {
      map_.observe(point, loop.here, feature);
    } else {
      map_.fuse(own, point);
    }
  }
  const std::set<PointId> around = points_around(map_, loop.there);
  const std::vector<PointId> nearby_points(around.begin(), around.end());
  for (const KeyframeId id : side) fuse_points(map_, nearby_points, id, camera_, kLoopRadius_px);
  Keyframe& here = map_.keyframes.at(loop.here);
  Keyframe& there = map_.keyframes.at(loop.there);
  here.loops[loop.there] = here.pose * there.pose.inverse();
  there.loops[loop.here] = there.pose * here.pose.inverse();
  std::map<KeyframeId, CameraFromTarget> moved = before;
  for (const KeyframeId id : side) {
    map_.update_neighbours(id);
    moved[id] = map_.keyframes.at(id).pose;
  }
  // Edges created by the loop: between covisible keyframes of the two sides, at their present poses.
  const std::set<KeyframeId> here_side(side.begin(), side.end());
  for (const KeyframeId id : side) {
    for (const auto& [other, shared] : map_.keyframes.at(id).neighbours) {
      if (here_side.contains(other)) continue;
      edges.push_back({id, other, moved.at(id) * moved.at(other).inverse()});
    }
  }
  edges.push_back({loop.here, loop.there, here.loops.at(loop.there)});
  std::map<KeyframeId, CameraFromTarget> solved = moved;
  adjust_pose_graph(solved, edges, {map_.keyframes.begin()->first});
  for (auto& [id, keyframe] : map_.keyframes) keyframe.pose = solved.at(id);
  move_points(map_, moved, {});
  closed_at_ = loop.here;
}

void apply_global(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map) {
  std::map<KeyframeId, CameraFromTarget> before;
  for (const auto& [id, keyframe] : map.keyframes) before[id] = keyframe.pose;
  apply(solved, rejected, map);
  for (auto& [id, keyframe] : map.keyframes) {
    if (solved.poses.contains(id) || keyframe.parent == kNone) continue;
    keyframe.pose = before.at(id) * before.at(keyframe.parent).inverse() * map.keyframes.at(keyframe.parent).pose;
  }
  std::set<PointId> solved_points;
  for (const auto& [id, position] : solved.points) solved_points.insert(id);
  move_points(map, before, solved_points);
}

}  // namespace pharos::slam
