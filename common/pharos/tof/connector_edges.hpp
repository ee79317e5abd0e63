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

/// Fits a rectangle to where the face's own light ends (layer_intensity.hpp) around a region: a region's centroid is
/// only good to a tenth of a pixel, as its rim is cut by noise. Light of the surroundings, which may be the brighter
/// side, has no part; upright walls in sight below a side are counted.
///
/// `edge_points` is 0 where a side has no edge: the region's own centre then serves, with the deviation that it has.
ConnectorFace fit_face(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const RegionReport& region);

/// The same for a region whose outline is not a connector's, because noise or foil has grown on to it: the square of
/// `like`'s size that stands highest within the region is fitted instead, turned by steps until its edges are found.
ConnectorFace fit_face_within(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                              const RingFit& ring, const RegionReport& region, const ConnectorFace& like);

}  // namespace pharos::tof
