// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/raised_box.hpp"
#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// Heights over the ring's plane of a raised box' top and of the plate around it, m.
struct TopHeight {
  double height_m = 0.0;
  double sigma_height_m = 0.0;
  double base_m = 0.0;
  double light = 0.0;  ///< of the top, counts; 0: too few of its pixels have a depth
};

/// The top by its inner pixels, the plate by what surrounds the box; those of the box itself where too few have a
/// depth.
TopHeight top_height_of(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& ring,
                        const RaisedBox& box);

}  // namespace pharos::tof
