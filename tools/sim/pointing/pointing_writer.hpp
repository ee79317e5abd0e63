// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "tools/sim/pointing/pointing_scenario.hpp"

namespace pharos::sim {

/// Images NNNN.png, camera.toml, track.csv (what the station knows) and truth.csv into `folder`, which is made. `done`
/// is called after each image. Throws host::InputError where that cannot be written or rendered.
void write_pointing_images(const PointingScenario& scenario, std::uint64_t seed, const std::filesystem::path& folder,
                           const std::function<void()>& done);

}  // namespace pharos::sim
