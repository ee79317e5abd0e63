// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// For a ring with only one of its edges among the image's ellipses: the plane of the depths beside it is followed to
/// its end, which is the other edge.
///
/// `known`: the edge that the ellipse is assumed to be. Nothing where the depths beside it are no plane, where the
/// plane continues beyond `min_ratio` of inner over outer radius (a wall), or ends at once (no ring). The other radius
/// is accurate to a pixel: fit_ring refines it.
std::optional<RingModel> ring_from_one_edge(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                            const ellipse::Ellipse& shape, RingEdge known, double min_ratio);

/// Both radii again, from where the depths leave the plane in most directions, outwards and inwards from the middle of
/// the ring, whatever the source of its edges. Accurate to a pixel. Nothing where the plane does not begin or does not
/// end.
std::optional<RingModel> ring_from_plane_extent(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                                const RingModel& model, double gate_m);

/// The image of one of the ring's circles: the ellipse through 24 of its points, which a lens without distortion shows
/// exactly. Nothing where they do not all have a pixel.
std::optional<ellipse::Ellipse> image_of(const RingModel& model, RingEdge edge, const PinholeCamera& camera);

}  // namespace pharos::tof
