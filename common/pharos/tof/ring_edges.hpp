// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

/// Maximum points around one circle: the longest contour in a frame of 640 x 480 has some 1500 px, and every second
/// pixel gives nearly as much information as every one.
inline constexpr std::size_t kMaxEdgePoints = 768;

/// Edge of the ring's own intensity near a circle's expected image.
struct RingEdgePoint {
  Vector3 point_m = Vector3::Zero();    ///< of the model's circle, frame C
  Vector2 normal_px = Vector2::Zero();  ///< unit, across the contour, away from the ring's middle
  double offset_px = 0.0;               /// of the edge found, along the normal, the wall's effect removed
  double strength = 0.0;                ///< of the change there, grey values per px
  double wall_shift_px = 0.0;           /// correction for the ring's own wall in sight beyond the edge
  Vector2 direction = Vector2::Zero();  ///< from the middle, in the ring's plane, unit
};
using RingEdgePoints = StaticVector<RingEdgePoint, kMaxEdgePoints>;

/// Derivatives of an edge's position along its normal, px, by the ring's unknowns: rotation about the plane's two axes
/// (axes_of), rad; centre, m; outer, inner radius, m.
Vector7 edge_row(const DepthCamera& camera, const RingModel& model, const PlaneAxes& axes, const Vector3& point_m,
                 const Vector2& normal_px, RingEdge edge);

/// What is known of the ring before its edges are searched.
struct RingPrior {
  double depth_gate_m = 0.0;  ///< distance from the plane within which a pixel is the ring's
  double amplitude = 0.0;     ///< median of the ring's pixels, counts
  double min_step_m = 0.0;    ///< how far behind the plane the surroundings must lie
};

/// Whether two of three depths around a point of the model's plane lie on it, within gate_m.
bool on_plane(const TofFrame& frame, const DepthCamera& camera, const Vector3& point, double gate_m);

/// Edges of the ring's layer intensity (layer_intensity.hpp) across the image of one of its circles, `search_px` to
/// either side.
///
/// The steepest point of each profile (smoothed by a Gaussian of 1 px), to a fraction of a pixel by a parabola,
/// corrected for an upright wall in sight beyond the edge (light falls with the cosine, and with the wall's depth).
/// Left out are directions where the ring's middle line has no depth on the plane (occluded), where there is no step
/// down beyond the edge, and where the wall is half as bright as the ring. Returns the fraction of directions that were
/// seen; 0 where the ring's image cannot be computed.
double find_ring_edges(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                       RingEdge edge, double search_px, const RingPrior& prior, RingEdgePoints& points);

}  // namespace pharos::tof
