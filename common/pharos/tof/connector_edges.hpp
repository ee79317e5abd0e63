// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/connector.hpp"
#include "pharos/tof/image_profile.hpp"

namespace pharos::tof {

/// Position of the connector's face.
struct ConnectorFace {
  PlanarRectangle rectangle;
  double height_m = 0.0;  ///< over the ring's plane
  double sigma_height_m = 0.0;
  Matrix2 covariance = Matrix2::Zero();  ///< of the centre, in the ring's plane, m^2
  double edge_rms_px = 0.0;
  std::int32_t edge_points = 0;
};

/// Fits a rectangle to the edges of the face's layer intensity (layer_intensity.hpp) around a region: a region's
/// centroid is only accurate to a tenth of a pixel, as its rim is affected by noise. Light of the surroundings, which
/// may be the brighter side, has no influence; upright walls in sight below a side are modelled.
///
/// `edge_points` is 0 where a side has no edge: the region's own centre is then used, with its own deviation.
ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const RegionReport& region);

/// The same for a region whose outline is not a connector's, because noise or foil has enlarged it: the square of the
/// size of `like` with the greatest mean height within the region is fitted instead, rotated in steps until its edges
/// are found.
ConnectorFace fit_face_within(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                              const RingFit& ring, const RegionReport& region, const ConnectorFace& like);

}  // namespace pharos::tof
