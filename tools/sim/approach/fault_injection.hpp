// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/approach/approach_simulator.hpp"

namespace pharos::sim {

/// Changes what one source answered between the fault's times; `measurements` are all of that source.
void inject(const DrawnFault& fault, double ramp_s, std::uint64_t seed, std::vector<ApproachMeasurement>& measurements);

}  // namespace pharos::sim
