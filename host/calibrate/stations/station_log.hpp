// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pharos/network/sweep.hpp"

namespace pharos::calibrate {

/// A hit of a recording, its station by number.
struct NetworkHit {
  std::uint8_t station = 0;
  std::size_t plane = 0;
  network::Hit hit;
};

/// A recording of a target under several stations, in the order of time.
struct NetworkLog {
  std::string name;  // for messages
  std::vector<NetworkHit> hits;
};

/// The passes of single planes over the target. `stations`: hits of others are left out.
std::vector<network::PlaneSweep> plane_sweeps(const NetworkLog& log, const network::Stations& stations);

}  // namespace pharos::calibrate
