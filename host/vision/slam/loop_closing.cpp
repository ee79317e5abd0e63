// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/loop_closing.hpp"

#include <algorithm>
#include <numbers>

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
constexpr std::size_t kMinAligned = 20;  // of a loop that binds the sides by them alone, in all its keyframes
constexpr double kMaxView_rad = 20.0 * std::numbers::pi / 180.0;  // descriptors are known again
constexpr int kStrong = 100;                                      // shared points of an edge of the essential graph

// Of the keyframes that are not `connected` the one that looks from the most similar direction, as the trajectory
// tells; kNone where none is within kMaxView. Words are too few for this: they propose other views of alike material
// too.
KeyframeId same_view(const Map& map, const Keyframe& here, const std::set<KeyframeId>& connected) {
  double depth_m = 0.0, count = 0.0;
  for (const PointId id : here.points) {
    if (id == kNone) continue;
    depth_m += (here.pose * map.points.at(id).position_m).z();
    count += 1.0;
  }
  const Vector3 eye = here.pose.inverse().t;
  KeyframeId best = kNone;
  double smallest_rad = kMaxView_rad;
  for (const auto& [id, keyframe] : map.keyframes) {
    if (connected.contains(id) || id > here.id) continue;
    if (!((keyframe.pose.inverse().t - eye).norm() * count < kMaxView_rad * depth_m)) continue;
    const double angle_rad = rotation_angle_between(keyframe.pose.R, here.pose.R);
    if (angle_rad >= smallest_rad) continue;
    smallest_rad = angle_rad;
    best = id;
  }
  return best;
}

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

std::optional<Loop> LoopCloser::find(KeyframeId id, const std::vector<PyramidLevel>& pyramid) {
  if (!map_.keyframes.contains(id) || id < kMinApart || (closed_at_ != kNone && id < closed_at_ + kMinApart)) {
    return std::nullopt;
  }
  const Keyframe& here = map_.keyframes.at(id);
  std::set<KeyframeId> connected{id};
  for (const auto& [near, shared] : here.neighbours) {
    connected.insert(near);
    for (const auto& [other, also] : map_.keyframes.at(near).neighbours) connected.insert(other);
  }
  const std::vector<KeyframeId> candidates = candidates_of(here, connected);
  std::optional<Loop> found;
  bool rival = false;
  for (const KeyframeId candidate : candidates) {
    auto loop = check(here, candidate, pyramid);
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

LoopDecision LoopCloser::decide(KeyframeId id, const std::vector<PyramidLevel>& pyramid) {
  LoopDecision out;
  if (!provisional_) {
    if (auto loop = find(id, pyramid)) provisional_.emplace(std::move(*loop));
    return out;
  }
  const ProvisionalLoop::Verdict verdict = provisional_->hear(map_, id, camera_, pyramid);
  if (verdict == ProvisionalLoop::Verdict::kConfirmed) out.close = provisional_->loop();
  if (verdict == ProvisionalLoop::Verdict::kContradicted) {
    out.taken_back = provisional_->loop();
    ++counts_.taken_back;
  }
  if (verdict != ProvisionalLoop::Verdict::kOpen) provisional_.reset();
  return out;
}

std::vector<KeyframeId> LoopCloser::candidates_of(const Keyframe& here, const std::set<KeyframeId>& connected) const {
  std::vector<KeyframeId> out;
  for (const auto& like : keyframe_database_.detect_candidates(here.words, map_, connected)) {
    if (out.size() < kMaxLoopCandidates) out.push_back(like.keyframe);
  }
  const KeyframeId near = same_view(map_, here, connected);
  if (near != kNone && std::find(out.begin(), out.end(), near) == out.end()) out.push_back(near);
  return out;
}

std::optional<Loop> LoopCloser::check(const Keyframe& here, KeyframeId candidate,
                                      const std::vector<PyramidLevel>& pyramid) {
  ++counts_.candidates;
  std::optional<Loop> loop = fit(here, candidate, pyramid);
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

// By descriptors alone; where too few are alike, from where the trajectory says that the keyframe is.
CameraFromTarget LoopCloser::start_at(const Keyframe& here, const Keyframe& there) const {
  std::vector<bool> known(there.points.size());
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = there.points[k] != kNone;
  std::vector<Observation> observations;
  for (const ProjectionMatch& match : match_by_descriptor(there.features, known, here.features, {}, 0.85)) {
    const PointId point = there.points[static_cast<std::size_t>(match.candidate)];
    observations.push_back(
        corner_of(here.features[static_cast<std::size_t>(match.feature)], map_.points.at(point).position_m));
  }
  const auto placed = robust_pose(observations, camera_, kMinDescriptorMatches, static_cast<std::uint64_t>(here.id));
  return placed ? placed->pose : here.pose;
}

std::optional<Loop> LoopCloser::fit(const Keyframe& here, KeyframeId candidate,
                                    const std::vector<PyramidLevel>& pyramid) const {
  const CameraFromTarget start = start_at(here, map_.keyframes.at(candidate));
  const PlaceFit refined = fit_place(map_, here, start, candidate, camera_, pyramid);
  if (refined.pose.inliers < kMinInliers) return std::nullopt;
  return Loop{here.id,           candidate,
              refined.pose.pose, covariance_of(refined, map_, here, camera_),
              refined.seen,      {{here.id, refined.aligned}}};
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

// The keyframes get features at the aligned positions of the place's points: these bind the sides by a tenth of a
// pixel. Duplicates are not fused, because observations of one of two fused points count as corners. False where too
// few are aligned.
bool LoopCloser::observe_aligned(const Loop& loop) {
  std::size_t aligned = 0;
  for (const auto& [id, points] : loop.aligned) aligned += points.size();
  if (aligned < kMinAligned) return false;
  for (const auto& [id, points] : loop.aligned) {
    const auto at = map_.keyframes.find(id);
    if (at == map_.keyframes.end()) continue;
    for (const auto& [point, feature] : points) {
      if (!map_.points.contains(point) || map_.points.at(point).seen_by.contains(id)) continue;
      const auto added = at->second.features.size();
      at->second.features.push_back(feature);
      at->second.points.push_back(kNone);
      map_.observe(point, id, static_cast<int>(added));
      at->second.features.back().sigma_px = feature.sigma_px;
    }
  }
  return true;
}

void LoopCloser::fuse_sides(const Loop& loop, const std::vector<KeyframeId>& side) {
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
}

void LoopCloser::correct(const Loop& loop) {
  std::map<KeyframeId, CameraFromTarget> before;
  for (const auto& [id, keyframe] : map_.keyframes) before[id] = keyframe.pose;
  // Edges of the state before duplicate points are fused between the two sides.
  std::vector<PoseEdge> edges = essential_edges(before);
  std::vector<KeyframeId> side = map_.best_neighbours(loop.here, map_.keyframes.size());
  side.push_back(loop.here);
  move_side(loop, side);
  if (!observe_aligned(loop)) fuse_sides(loop, side);
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
