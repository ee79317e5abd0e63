// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "pharos/base/result.hpp"
#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/tof/ring_fit.hpp"
#include "pharos/tof/tof_failure.hpp"
#include "pharos/tof/tof_stages.hpp"

namespace pharos::tof {

/// The docking ring among the image's ellipses.
struct RingChoice {
  ellipse::Ellipse outer;  ///< as detected, or the image of an edge found by depth
  ellipse::Ellipse inner;
  RingFit fit;
};

/// Chooses the ring's two ellipses and measures it (paper 000, 2.2.1 and 2.3).
///
/// Of every two nested ellipses of one shape: a plane must fit the depths between them; on it they must be concentric
/// circles of a docking ring's size; inside and outside the surroundings must lie behind it. A nozzle's rim has no
/// plane between its ellipses, circles painted on a surface have no step. The pair with the most pixels on its plane is
/// measured. Where no pair is the ring, single ellipses are tried with the other edge found in the depths
/// (ring_extent.hpp). The error is that of the candidate that passed the most checks. `listener`, if any, is notified
/// of kPlane and kRing.
Result<RingChoice, TofFailure> choose_ring(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                           std::span<const ellipse::DetectedEllipse> ellipses,
                                           const RingSettings& settings, const DepthNoise& noise,
                                           RingFitWorkspace& workspace, TofStageListener* listener = nullptr);

}  // namespace pharos::tof
