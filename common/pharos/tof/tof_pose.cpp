// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_pose.hpp"

#include <cmath>

#include "pharos/ellipse/detect.hpp"

namespace pharos::tof {
namespace {

constexpr double kPartlyHidden = 0.9;

bool is_good(const TargetPose& target) {
  if (!target.pose.is_finite() || !target.covariance.allFinite()) return false;
  return (target.covariance.diagonal().array() > 0.0).all();
}

void add_connector(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                   TofWorkspace& workspace, TofPose& result) {
  const RingFit& ring = result.ring.fit;
  find_connectors(frame, camera, workspace.rays, ring, settings.connector, workspace.connector);
  const auto& connectors = workspace.connector.connectors;
  if (connectors.empty()) {
    result.flags |= kFlagNoConnector;
    result.target = target_pose_without_turn(ring);
    return;
  }
  const auto face_of = [&](const RegionReport& region) {
    return fit_face(frame, camera, workspace.rays, ring.model, region);
  };
  result.connector = face_of(connectors[0]);
  result.target = target_pose(ring, result.connector);
  if (result.connector.edge_points == 0) result.flags |= kFlagCoarseConnector;
  if (connectors.size() == 1) {
    if ((result.flags & kFlagRingPartlyHidden) != 0) result.flags |= kFlagLoneConnector;
    return;
  }
  const ConnectorFace other = face_of(connectors[1]);
  const double nearest = result.connector.rectangle.centre_m.norm();
  const double next = other.rectangle.centre_m.norm();
  if (std::fabs(next - nearest) < settings.connector.least_difference_m) {
    result.second = target_pose(ring, other);
  } else if (next < nearest) {
    // Regions said otherwise than edges do.
    result.connector = other;
    result.target = target_pose(ring, other);
  }
}

}  // namespace

Result<TofPose, TofFailure> measure_tof_pose(const TofFrame& frame, const DepthCamera& camera,
                                             const TofSettings& settings, TofWorkspace& workspace) {
  workspace.connector.regions.clear();
  workspace.connector.connectors.clear();
  workspace.ellipse.found.clear();
  workspace.ellipse.arcs.clear();
  for (RingEdgePoints& points : workspace.edges.points) points.clear();
  if (const auto failure = workspace.frames.check(frame, camera)) return *failure;
  if (!workspace.rays.prepare(camera.optics)) return TofFailure::kCameraUnusable;
  const auto ellipses = ellipse::detect_ellipses(frame.intensity, settings.ellipse, workspace.ellipse);
  const auto ring =
      choose_ring(frame, camera, workspace.rays, ellipses, settings.ring, settings.noise, workspace.edges);
  if (!ring) return ring.error();
  TofPose result;
  result.ring = *ring;
  if (ring->fit.seen < kPartlyHidden) result.flags |= kFlagRingPartlyHidden;
  add_connector(frame, camera, settings, workspace, result);
  if (!is_good(result.target)) return TofFailure::kRingNotCircles;
  return result;
}

}  // namespace pharos::tof
