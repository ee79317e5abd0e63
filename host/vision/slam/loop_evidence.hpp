// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam {

inline constexpr double kLoopRadius_px = 5.0;  ///< of the search for points of the other side of a loop

/// Inliers by which another keyframe confirms a loop: half of what its own keyframe needs, because it sees less of the
/// place.
inline constexpr int kMinAgreed = 20;

/// A feature's observation of a point with whose patch it was not aligned: it counts as a corner.
Observation corner_of(const Feature& feature, const Vector3& point_m);

/// Points of a keyframe and of the ten that share most points with it.
std::set<PointId> points_around(const Map& map, KeyframeId keyframe);

/// A point of a place in a keyframe: a feature at the aligned position of the point's patch.
using AlignedPoint = std::pair<PointId, Feature>;

/// A keyframe's pose from the points around another one.
struct PlaceFit {
  PoseOnly pose;
  std::vector<std::pair<int, PointId>> seen;  ///< points that fit as corners, and the keyframe's features
  std::vector<AlignedPoint> aligned;          ///< of those, points that fit as patches
};
/// The points are matched as corners near where `start` predicts them; then their patches are aligned in `pyramid`, of
/// the keyframe's left image (empty: they stay corners). Corners are found the more often on one side the farther the
/// view turns: of a random body's place seen from 10 to 20 deg off, 0.2 deg, and of its aligned patches 0.03 to 0.1.
PlaceFit fit_place(const Map& map, const Keyframe& keyframe, const CameraFromTarget& start, KeyframeId there,
                   const StereoCamera& camera, const std::vector<PyramidLevel>& pyramid = {});

/// Of the fitted pose, as a covariance of zeta (place_gate.hpp): that of its points and, because they were made in
/// other keyframes, of one more link of the graph.
Matrix6 covariance_of(const PlaceFit& place, const Map& map, const Keyframe& keyframe, const StereoCamera& camera);

/// Whether the points of `seen` are on one plane within three sigma of stereo depth, but for fewer than a quarter of
/// the inliers that a loop needs: cells of a wing repeat, and a shift by one of them fits as well.
bool on_one_plane(const Map& map, const std::vector<std::pair<int, PointId>>& seen, const Keyframe& keyframe,
                  const StereoCamera& camera);

/// Whether most of the three keyframes that share most points with `here` also show the points around `there`, at the
/// poses that they have where `here` is at `corrected`. True where it has no neighbours.
bool neighbours_agree(const Map& map, const Keyframe& here, const CameraFromTarget& corrected, KeyframeId there,
                      const StereoCamera& camera);

}  // namespace pharos::slam
