// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/geometry/target.hpp"
#include "pharos/geometry/types.hpp"
#include "pharos/motion/rotor_spread.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tracking {

/// Covariance that the rotors' errors add to a pose that was computed by least squares from a cycle's bearings; `cycle`
/// is the tracker that solved it last. Empty if the bearings that it used do not determine a pose.
std::optional<Matrix6> rotor_covariance(const LighthouseFromBody& T_lighthouse_body, const track::EpochTracker& cycle,
                                        const Target& target, const motion::RotorSpread& spread);

}  // namespace pharos::tracking
