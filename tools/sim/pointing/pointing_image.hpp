// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/images/grey_image.hpp"
#include "tools/sim/pointing/pointing_scenario.hpp"

namespace pharos::sim {

/// The satellite in POV-Ray's language, seen from the telescope; (u, v) is where its middle stands in the image.
std::string pointing_scene(const PointingScenario& scenario, const PointingView& view, const Vector2& middle_px);

/// One image: rendered, stars beside, blurred by seeing, exposed. `index` picks the random numbers of `seed`.
host::GreyImage pointing_image(const PointingScenario& scenario, std::size_t index, std::uint64_t seed);

}  // namespace pharos::sim
