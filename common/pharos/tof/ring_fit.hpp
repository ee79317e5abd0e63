// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/ring_edges.hpp"
#include "pharos/tof/ring_light.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::tof {

/// The measured ring.
struct RingFit {
  RingModel model;
  /// Of (rotation about the plane's first and second axis (axes_of), rad; centre, frame C, m; outer, inner radius, m).
  Matrix7 covariance = Matrix7::Zero();
  double edge_rms_px = 0.0;
  double plane_rms_m = 0.0;
  double amplitude = 0.0;  ///< median of the ring's pixels, counts
  std::int32_t edge_points = 0;
  std::int32_t plane_pixels = 0;
  double seen = 0.0;  /// fraction of the circumference with depth on the plane
  /// Disagreement of edges and depths about the plane: chi-squared of three degrees of freedom.
  double plane_chi2 = 0.0;
  WallLight walls;
};

/// Derivatives of the positions of a circle's edge points by the fit's unknowns, px.
using RingEdgeRows = std::array<Vector7, kMaxEdgePoints>;

/// Where the edges of a ring are found, between rounds of the fit, and their rows.
struct RingFitWorkspace {
  std::array<RingEdgePoints, 2> points;
  std::array<RingEdgeRows, 2> rows;
  RingLightWorkspace light;
};

/// Two concentric circles in the plane of the depths: all measurements of the ring in one least-squares fit.
///
/// Unknowns: two rotations of the plane, its centre, two radii. Observations: the plane of the depths (with its
/// information) and the offsets of the image's edges from the circles' exact images, lens distortion included, so that
/// a circle's centre is never taken for its image's centre. Three rounds, in each of which edges are searched again
/// near the circles' new images. Nothing where edges are too few or the fit does not converge.
std::optional<RingFit> fit_ring(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                const PlaneFit& plane, const RingModel& start, double min_step_m,
                                const DepthNoise& noise, RingFitWorkspace& workspace);

/// Concentric circles in `plane` through the images of two ellipses: the start of fit_ring. Nothing where the plane
/// does not meet their rays.
std::optional<RingModel> ring_on_plane(const DepthPlane& plane, const RayGrid& rays, const ellipse::Ellipse& outer,
                                       const ellipse::Ellipse& inner);

}  // namespace pharos::tof
