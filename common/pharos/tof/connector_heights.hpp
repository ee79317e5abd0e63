// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/height_image.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

/// Heights over the ring's plane that connectors are looked for in. The ring stands higher than what surrounds it and
/// would lift the local mean beside a connector; the body's sides, deeper than the face that carries the ring, would
/// lower it beside the face's rim. Neither has a height.
void make_connector_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                            const RingModel& ring, const PixelRect& rect, ImageView<std::uint16_t> heights);

}  // namespace pharos::tof
