// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/height_image.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

/// Heights over the ring's plane in which connectors are searched. The ring stands higher than its surroundings and
/// would raise the local mean beside a connector; the body's sides, deeper than the face that carries the ring, would
/// lower it beside the face's rim. Both are left out.
void make_connector_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                            const RingModel& ring, const PixelRect& rect, ImageView<std::uint16_t> heights);

}  // namespace pharos::tof
