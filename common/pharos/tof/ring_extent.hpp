// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// A ring that only one of whose edges is among the image's ellipses: the plane of the depths beside it is followed to
/// where it ends, and that is the other edge.
///
/// `known` says which edge the ellipse is taken for. Nothing where the depths beside it are no plane, where the plane
/// goes on beyond `min_ratio` of inner over outer radius (a wall), or ends at once (no ring). The other radius is
/// good to a pixel: fit_ring does the rest.
std::optional<RingModel> ring_from_one_edge(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                            const ellipse::Ellipse& shape, RingEdge known, double min_ratio);

/// Both radii anew, from where the depths leave the plane in most directions, going out and in from the middle of the
/// ring: whatever edges it came from. Good to a pixel. Nothing where the plane does not begin or does not end.
std::optional<RingModel> ring_from_plane_extent(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                                const RingModel& model, double gate_m);

/// The image of one of the ring's circles: the ellipse through 24 of its points, which a lens without distortion shows
/// exactly. Nothing where they do not all have a pixel.
std::optional<ellipse::Ellipse> image_of(const RingModel& model, RingEdge edge, const PinholeCamera& camera);

}  // namespace pharos::tof
