// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/keyframe_database.hpp"
#include "host/vision/slam/map.hpp"

namespace pharos::slam {

// The steps of local mapping (2.3) that change the map; local bundle adjustment is in bundle.hpp.

/// Creates points for the keyframe's stereo features without one: all near ones, and of the others the nearest up to
/// 100.
void add_stereo_points(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// Creates patches for the keyframe's points without one, from its features with a depth; `pyramid` is that of its
/// image.
void add_patches(Map& map, KeyframeId keyframe, const std::vector<PyramidLevel>& pyramid);

/// Creates points from features of the keyframe and a covisible one that have none: best match by descriptor along the
/// epipolar line, parallax above 1 deg or a stereo depth, reprojections within chi-squared in both. Returns how many.
int triangulate(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// Fuses duplicate points of the keyframe, its covisible keyframes and theirs; adds missed observations. Recomputes
/// covisibility.
void fuse_with_neighbours(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// Matches points to a keyframe by projection: a match becomes an observation, or is fused with the feature's point.
/// Returns how many.
int fuse_points(Map& map, const std::vector<PointId>& points, KeyframeId into, const StereoCamera& camera,
                double radius_px);

/// Removes recent points that were found in less than a quarter of the frames in which they should be visible, or that
/// fewer than three keyframes observe three keyframes after their creation.
void cull_points(Map& map, std::vector<PointId>& recent);

/// Removes covisible keyframes of which nine in ten points are observed by three others at least as well; and
/// while the map has more than `maximum` (0: no limit) the one that most of whose points others observe, but the newest
/// five. Returns how many.
int cull_keyframes(Map& map, KeyframeId keyframe, KeyframeDatabase* keyframe_database, std::size_t maximum);

}  // namespace pharos::slam
