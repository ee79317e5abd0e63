// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/target.hpp"
#include "pharos/network/recent_sweeps.hpp"
#include "pharos/network/station.hpp"

namespace pharos::network {

inline constexpr std::size_t kMaxStarts = 2 * kMaxNetworkStations;
using Starts = StaticVector<WorldFromBody, kMaxStarts>;

/// Poses that single stations give alone: for each station the last sweep of either plane, as ideal bearings of the
/// sensors that both hit, solved (pose::solve) with both minima. Their range may be off by percents.
Starts starts_of(const SweepView& recent, const Stations& stations, const Target& target);

}  // namespace pharos::network
