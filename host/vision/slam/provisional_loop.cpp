// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/provisional_loop.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "host/vision/slam/local_map.hpp"
#include "host/vision/slam/loop_evidence.hpp"
#include "host/vision/slam/place_gate.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::slam {
namespace {

constexpr int kDecides = 2, kMaxAsked = 20;  // keyframes
constexpr double kMaxView_rad = 20.0 * std::numbers::pi / 180.0;
constexpr double kMinFoundRatio = 0.5;
constexpr double kApart_rad = 5.0 * std::numbers::pi / 180.0;  // alike parts of a body are farther apart
constexpr double kDriftSigmas = 5.0;

// Of the place and its neighbours the keyframe that looks from the most similar direction; kNone where none is near.
KeyframeId nearest_view(const Map& map, KeyframeId there, const CameraFromTarget& pose) {
  std::vector<KeyframeId> around = map.best_neighbours(there, map.keyframes.size());
  around.push_back(there);
  KeyframeId best = kNone;
  double smallest_rad = kMaxView_rad;
  for (const KeyframeId id : around) {
    const double angle_rad = rotation_angle_between(map.keyframes.at(id).pose.R, pose.R);
    if (angle_rad >= smallest_rad) continue;
    smallest_rad = angle_rad;
    best = id;
  }
  return best;
}

// Whether a camera at the pose sees the point, as far as its other observations tell.
bool is_expected(const MapPoint& point, const CameraFromTarget& pose, const StereoCamera& camera) {
  const Vector3 p = pose * point.position_m;
  if (!(p.z() > kMinDepth_m)) return false;
  const Vector3 place = camera.project(p);
  if (!(place.x() >= 0.0 && place.x() < camera.width_px && place.y() >= 0.0 && place.y() < camera.height_px)) {
    return false;
  }
  return (point.position_m - pose.inverse().t).dot(point.normal) > kCosMaxTurn * p.norm();
}

// How many of the points expected at the pose are found.
struct FoundRate {
  double expected = 0.0, found = 0.0;
  void add(bool is_found) {
    expected += 1.0;
    found += is_found ? 1.0 : 0.0;
  }
  double value() const { return expected > 0.0 ? found / expected : 0.0; }
};

// Of the points that the keyframe's neighbours observe.
FoundRate own_rate(const Map& map, const Keyframe& next, const StereoCamera& camera) {
  FoundRate rate;
  for (const PointId id : points_around(map, next.id)) {
    const MapPoint& point = map.points.at(id);
    const bool is_found = point.seen_by.contains(next.id);
    if (is_found && point.seen_by.size() == 1) continue;
    if (is_expected(point, next.pose, camera)) rate.add(is_found);
  }
  return rate;
}

FoundRate place_rate(const Map& map, KeyframeId view, const PlaceFit& place, const StereoCamera& camera) {
  std::set<PointId> seen;
  for (const auto& [feature, id] : place.seen) seen.insert(id);
  FoundRate rate;
  for (const PointId id : points_around(map, view)) {
    const MapPoint& point = map.points.at(id);
    if (is_expected(point, place.pose.pose, camera)) rate.add(seen.contains(id));
  }
  return rate;
}

bool agrees(const Map& map, const Loop& loop, const Keyframe& next, const CameraFromTarget& expected, KeyframeId view,
            const StereoCamera& camera, const PlaceFit& found) {
  if (found.pose.inliers < kMinAgreed) return false;
  const Matrix6 covariance =
      covariance_of(found, map, next, camera) + loop.covariance + drift_between(map, next.id, loop.here, camera);
  if (contradicts(place_offset(found.pose.pose, expected), covariance)) return false;
  // Where the trajectory is known to a few degrees about every axis, no other part of the body can be meant.
  const Matrix3 drift = drift_between(map, next.id, view, camera).topLeftCorner<3, 3>();
  if (kDriftSigmas * std::sqrt(symmetric_eigen<3>(drift).values[2]) < kApart_rad) return true;
  return place_rate(map, view, found, camera).value() >= kMinFoundRatio * own_rate(map, next, camera).value();
}

}  // namespace

ProvisionalLoop::Verdict ProvisionalLoop::hear(const Map& map, KeyframeId id, const StereoCamera& camera,
                                               const std::vector<PyramidLevel>& pyramid) {
  if (!map.keyframes.contains(loop_.here) || !map.keyframes.contains(loop_.there)) return Verdict::kDropped;
  if (++asked_ > kMaxAsked) return Verdict::kDropped;
  const auto at = map.keyframes.find(id);
  if (at == map.keyframes.end()) return Verdict::kOpen;
  const Keyframe& next = at->second;
  const CameraFromTarget expected = next.pose * map.keyframes.at(loop_.here).pose.inverse() * loop_.corrected;
  const KeyframeId view = nearest_view(map, loop_.there, expected);
  if (view == kNone) return Verdict::kOpen;
  const PlaceFit found = fit_place(map, next, expected, view, camera, pyramid);
  const bool agreed = agrees(map, loop_, next, expected, view, camera, found);
  ++(agreed ? agreed_ : disagreed_);
  if (agreed) loop_.aligned[id] = found.aligned;
  if (agreed_ == kDecides) return Verdict::kConfirmed;
  return disagreed_ == kDecides ? Verdict::kContradicted : Verdict::kOpen;
}

}  // namespace pharos::slam
