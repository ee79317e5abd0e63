// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "host/images/grey_image.hpp"
#include "tools/sim/ring2/ring2_scenario.hpp"

namespace pharos::sim {

/// One camera's image of one pair: rendered, blurred, exposed. Throws InputError.
host::GreyImage ring2_image(const Ring2Scenario& scenario, std::size_t pair, std::size_t view, std::uint64_t seed);

/// The rig as a rig file.
std::string rig_text_of(const StereoRig& rig);

/// Writes a scenario's pairs into `directory` (made where it is missing): rig.toml, truth.csv, ellipses.csv and, where
/// it renders, NNNN_left.png and NNNN_right.png. `after_each` is called after every pair. Throws InputError.
void write_ring2_pairs(const Ring2Scenario& scenario, std::uint64_t seed, const std::string& directory,
                       const std::function<void()>& after_each);

}  // namespace pharos::sim
