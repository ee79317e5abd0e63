// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/frame.hpp"

namespace pharos::slam {

/// A point that may be visible in a frame.
struct Candidate {
  PointId point = kNone;
  Vector3 position_m = Vector3::Zero();
  Descriptor descriptor;
  int level = 0;           ///< at which it is expected
  double radius_px = 7.0;  ///< of the search, on that level
  double angle_rad = 0.0;  ///< of its patch; used where orientations are checked
};

struct ProjectionMatch {
  int candidate = 0;
  int feature = 0;
  int distance = 0;
};

struct ProjectionRules {
  int max_distance = kHighDistanceThreshold;
  double ratio = 0.9;              ///< best distance over the second best of the same level
  bool check_orientation = false;  ///< drop matches whose rotation of the patch differs from that of most
};

/// Projects candidates by `pose` and matches each with the nearby feature of the smallest descriptor distance, and each
/// feature with the best of its candidates. Only features whose `free` is set (empty: all).
std::vector<ProjectionMatch> match_by_projection(const std::vector<Candidate>& candidates, const Frame& frame,
                                                 const std::vector<bool>& free, const StereoCamera& camera,
                                                 const CameraFromTarget& pose, const ProjectionRules& rules);

/// BestMatch features of two frames both ways, by descriptors alone; `from` and `to` select features (empty: all).
std::vector<ProjectionMatch> match_by_descriptor(const std::vector<Feature>& from, const std::vector<bool>& use_from,
                                                 const std::vector<Feature>& to, const std::vector<bool>& use_to,
                                                 double ratio);

/// Drops matches whose difference of angles is not among the three most frequent twelfths of a turn.
void filter_by_orientation(std::vector<ProjectionMatch>& matches, const std::vector<double>& angle_differences_rad);

}  // namespace pharos::slam
