// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/connector.hpp"
#include "pharos/tof/image_profile.hpp"

namespace pharos::tof {

/// The connector's face: where its middle lies.
struct ConnectorFace {
  PlanarRectangle rectangle;
  double height_m = 0.0;  ///< over the ring's plane
  double sigma_height_m = 0.0;
  Matrix2 covariance = Matrix2::Zero();  ///< of the centre, in the ring's plane, m^2
  double edge_rms_px = 0.0;
  std::int32_t edge_points = 0;
};

/// Fits a rectangle to the intensity image's edges around a region: a region's centroid is only good to a tenth of a
/// pixel, as its rim is cut by noise.
///
/// Edges are those of the silhouette. On a side whose wall the camera sees, that is the wall's foot: it lies in the
/// plan of the face, but as deep as the surroundings (box with upright walls). Nothing where fewer than three sides
/// have edges: the region's own centre then serves, with the deviation that it has.
ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& ring,
                       const RegionReport& region);

}  // namespace pharos::tof
