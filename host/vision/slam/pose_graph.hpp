// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "host/vision/slam/frame.hpp"

namespace pharos::slam {

/// A measured pose between two keyframes: T_from_to takes coordinates of `to` to `from`.
struct PoseEdge {
  KeyframeId from = kNone;
  KeyframeId to = kNone;
  Pose<frame::Camera, frame::Camera> T_from_to;
};

/// Residual of an edge: rotation log(R_i R_j^T R_ij^T) rad, then translation t_i - R_i R_j^T t_j - t_ij, m.
Vector6 edge_residual(const PoseEdge& edge, const CameraFromTarget& from, const CameraFromTarget& to);

/// Least squares of all edges over all poses but those of `fixed` (Ceres); in place. Poses without an edge do not
/// change.
void adjust_pose_graph(std::map<KeyframeId, CameraFromTarget>& poses, const std::vector<PoseEdge>& edges,
                       const std::vector<KeyframeId>& fixed);

}  // namespace pharos::slam
