// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "pharos/geometry/target.hpp"
#include "pharos/network/recent_sweeps.hpp"
#include "pharos/network/station.hpp"

namespace pharos::network {

/// What three or more stations that saw the body within the recent sweeps say of each other.
struct Consensus {
  bool contradiction = false;             // no position and velocity fits them all
  std::optional<std::size_t> dissenting;  // the one without which there is one, and without no other
};

/// Position and velocity by least squares of the sweeps' mean angles: a contradiction where they leave more than four
/// sigmas, a station that dissents where the others leave less than 2.5 without it, and without any other station still
/// more than four and 2.5 times as much. Three stations around a room have one angle more than their horizontal
/// position needs: who is wrong in that alone is not told. `near`: attitude, and where to begin; `unstated`: sigmas of
/// stations that state none.
///
/// Cost: a 6x6 solution for each station and one, some 20 us with three stations on a host.
Consensus consensus_of(const SweepView& recent, const Stations& stations, const Target& target,
                       const WorldFromBody& near, const StationSigmas& unstated);

}  // namespace pharos::network
