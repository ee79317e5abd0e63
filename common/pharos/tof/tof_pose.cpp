// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_pose.hpp"

#include <cmath>
#include <utility>

#include "pharos/ellipse/detect.hpp"
#include "pharos/tof/connector_choice.hpp"
#include "pharos/tof/described_turn.hpp"
#include "pharos/tof/relief_image.hpp"

namespace pharos::tof {
namespace {

constexpr double kPartlyHidden = 0.9;
// A boom that fills most of the frame, and the face behind it.
constexpr int kFacePlanes = 2;

void tell(TofStageListener* listener, TofStage ended) {
  if (listener != nullptr) listener->ended(ended);
}

bool is_good(const TargetPose& target) {
  if (!target.pose.is_finite() || !target.covariance.allFinite()) return false;
  return (target.covariance.diagonal().array() > 0.0).all();
}

std::uint8_t flag_of(ConnectorDoubt doubt) {
  switch (doubt) {
    case ConnectorDoubt::kMore:
      return kFlagMoreConnectors;
    case ConnectorDoubt::kUnlike:
    case ConnectorDoubt::kUnclear:
      return kFlagUnsureConnectors;
    case ConnectorDoubt::kHidden:
      return kFlagFewConnectors;
    case ConnectorDoubt::kNone:
    case ConnectorDoubt::kNoneSeen:
      return 0;
  }
  return 0;
}

// By the description: any one of its connectors gives the turn.
void add_described(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                   const TofWorkspace& workspace, TofPose& result) {
  const RingFit& ring = result.ring.fit;
  const auto turn = find_described_turn(frame, camera, workspace.rays, ring, settings.target, workspace.raised);
  if (!turn) {
    result.flags |= kFlagNoConnector;
    result.target = target_pose_without_turn(ring);
    return;
  }
  const auto pose_by = [&](const IdentifiedConnector& one) {
    const DescribedConnector& described = settings.target.connectors[one.described];
    const Vector2& place = described.place_m;
    return target_pose(ring, one.face, std::atan2(place.y(), place.x()), described.sigma_place_m / place.norm());
  };
  result.connector = turn->best.face;
  result.target = pose_by(turn->best);
  if (turn->best.face.edge_points == 0) result.flags |= kFlagCoarseConnector;
  if (turn->second) {
    result.second = pose_by(*turn->second);
    result.delta_chi2 = turn->delta_chi2;
  }
}

void add_connector(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                   TofWorkspace& workspace, TofStageListener* listener, TofPose& result) {
  const RingFit& ring = result.ring.fit;
  find_raised_boxes(frame, camera, workspace.rays, ring, settings.connector, workspace.raised);
  tell(listener, TofStage::kConnector);
  if (settings.target.stated()) return add_described(frame, camera, settings, workspace, result);
  const ConnectorChoice choice =
      choose_connector(frame, camera, workspace.rays, ring, settings.connector, workspace.raised);
  if (choice.doubt != ConnectorDoubt::kNone) {
    result.flags |= kFlagNoConnector;
    result.flags |= flag_of(choice.doubt);
    result.target = target_pose_without_turn(ring);
    return;
  }
  result.seen = choice.seen;
  result.connector = choice.seen[0].face;
  result.target = target_pose(ring, result.connector);
  if (!choice.seen[0].sure) result.flags |= kFlagCoarseConnector;
  if (choice.two_nearest) result.second = target_pose(ring, choice.seen[1].face);
}

std::span<const ellipse::DetectedEllipse> ellipses_in(ImageView<const std::uint16_t> image, const TofSettings& settings,
                                                      TofWorkspace& workspace, TofStageListener* listener) {
  ellipse::Contours contours;
  ellipse::trace_contours(image, workspace.ellipse, contours);
  tell(listener, TofStage::kEdges);
  const auto ellipses = ellipse::ellipses_along(contours, settings.ellipse, workspace.ellipse);
  tell(listener, TofStage::kEllipses);
  return ellipses;
}

// By the intensity image; where that does not show the ring (foil as bright beside it), by the relief over the face.
// The failure is the first one's.
Result<RingChoice, TofFailure> find_ring(const TofFrame& frame, const DepthCamera& camera, const TofSettings& settings,
                                         TofWorkspace& workspace, TofStageListener* listener) {
  const auto ring_in = [&](ImageView<const std::uint16_t> image) {
    const auto ellipses = ellipses_in(image, settings, workspace, listener);
    return choose_ring(frame, camera, workspace.rays, ellipses, settings.ring, settings.noise, workspace.edges,
                       listener);
  };
  const auto ring = ring_in(frame.intensity);
  if (ring) return ring;
  // Connectors are searched later: the memory of their heights is free.
  const ImageView<std::uint16_t> relief(workspace.connector.heights.data(), frame.depth.width_px,
                                        frame.depth.height_px);
  auto face = face_plane(frame, camera, workspace.rays, settings.noise);
  for (int plane = 0; face && plane < kFacePlanes; ++plane) {
    make_relief_image(frame, camera, workspace.rays, *face, relief);
    tell(listener, TofStage::kFace);
    const auto by_height = ring_in(relief);
    if (by_height) return by_height;
    const DepthPlane front = *face;
    face = face_plane(frame, camera, workspace.rays, settings.noise, &front);
  }
  return ring;
}

}  // namespace

Result<TofPose, TofFailure> measure_tof_pose(const TofFrame& frame, const DepthCamera& camera,
                                             const TofSettings& settings, TofWorkspace& workspace,
                                             TofStageListener* listener) {
  workspace.connector.regions.clear();
  workspace.connector.connectors.clear();
  workspace.raised.boxes.clear();
  workspace.ellipse.found.clear();
  workspace.ellipse.arcs.clear();
  for (RingEdgePoints& points : workspace.edges.points) points.clear();
  if (const auto failure = workspace.frames.check(frame, camera)) return *failure;
  if (!workspace.rays.prepare(camera.intrinsics)) return TofFailure::kCameraUnusable;
  tell(listener, TofStage::kCheck);
  const auto ring = find_ring(frame, camera, settings, workspace, listener);
  if (!ring) return ring.error();
  TofPose result;
  result.ring = *ring;
  if (ring->fit.seen < kPartlyHidden) result.flags |= kFlagRingPartlyHidden;
  add_connector(frame, camera, settings, workspace, listener, result);
  tell(listener, TofStage::kPose);
  if (!is_good(result.target)) return TofFailure::kRingNotCircles;
  return result;
}

}  // namespace pharos::tof
