// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

/// Most places around one circle: the longest contour in a frame of 640 x 480 has some 1500 px, and every second pixel
/// tells nearly as much as every one.
inline constexpr std::size_t kMostEdgePoints = 768;

/// Where the image's edge was found near a circle's expected image.
struct RingEdgePoint {
  Vector3 point_m = Vector3::Zero();    ///< of the model's circle, frame C
  Vector2 normal_px = Vector2::Zero();  ///< unit, across the contour, away from the ring's middle
  double offset_px = 0.0;               ///< of the edge found, along the normal
  double strength = 0.0;                ///< of the change there, grey values per px
  double contrast = 0.0;                ///< 1 - darker over brighter side: foil as bright as the ring moves its edge
  bool wall_in_sight = false;           ///< the ring's own wall lies beyond the edge: its shade moves it
  Vector2 direction = Vector2::Zero();  ///< from the middle, in the ring's plane, unit
};
using RingEdgePoints = StaticVector<RingEdgePoint, kMostEdgePoints>;

/// Edges of the intensity image along profiles across the image of one of the ring's circles, `search_px` to either
/// side.
///
/// The steepest place of the profile (smoothed by a Gaussian of 1 px) of the wanted sign, to a fraction of a pixel by a
/// parabola. `bright_inside`: the image falls outwards. Directions where the ring's middle line has no depth on the
/// plane within `depth_gate_m` are left out: something stands before it there. The share of directions that were seen
/// is returned; 0 where the ring's image cannot be computed.
double find_ring_edges(const TofFrame& frame, const DepthCamera& camera, const RingModel& model, RingEdge edge,
                       bool bright_inside, double search_px, double depth_gate_m, RingEdgePoints& points);

}  // namespace pharos::tof
