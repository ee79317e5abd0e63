// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/keyframe_database.hpp"
#include "host/vision/slam/map.hpp"

namespace pharos::slam {

// The steps of local mapping (2.3) that change the map; local bundle adjustment is bundle.hpp's.

/// Points for the keyframe's stereo features that show none yet: all near ones, and of the rest the nearest up to 100.
void add_stereo_points(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// The keyframe's points that have no patch yet get theirs from its features that have a depth; `pyramid` is of its
/// image.
void add_patches(Map& map, KeyframeId keyframe, const std::vector<PyramidLevel>& pyramid);

/// Points from features that the keyframe and a covisible one have and neither knows: likest by descriptor along the
/// epipolar line, crossing rays at more than 1 deg or a stereo depth, reprojections within chi-squared in both.
/// Returns how many.
int triangulate(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// Points of the keyframe and of its covisible keyframes (and theirs) that are one become one; sightings that were
/// missed are added. Neighbours are counted anew.
void fuse_with_neighbours(Map& map, KeyframeId keyframe, const StereoCamera& camera);

/// Matches points to a keyframe by projection: those it should see join its features, or their points. Returns how
/// many.
int fuse_points(Map& map, const std::vector<PointId>& points, KeyframeId into, const StereoCamera& camera,
                double radius_px);

/// Of points born in the last keyframes: those found in less than a quarter of the frames that should show them, or
/// seen by fewer than three keyframes after three, go.
void cull_points(Map& map, std::vector<PointId>& recent);

/// Covisible keyframes of which nine in ten points are seen by three others at least as well, go; and the oldest of
/// the covisible ones while the map holds more than `most` (0: no limit). Returns how many.
int cull_keyframes(Map& map, KeyframeId keyframe, KeyframeDatabase* keyframe_database, std::size_t maximum);

}  // namespace pharos::slam
