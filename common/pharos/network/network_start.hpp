// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/geometry/target.hpp"
#include "pharos/network/station.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::network {

inline constexpr std::size_t kMaxStarts = 2 * kMaxNetworkStations;
using Starts = StaticVector<WorldFromBody, kMaxStarts>;
/// Sweeps of the last fractions of a second, the oldest first.
inline constexpr std::size_t kRecentSweeps = 48;
using RecentSweeps = StaticVector<PlaneSweep, kRecentSweeps>;

/// Poses that single stations give alone: for each station the last sweep of either plane, as ideal bearings of the
/// sensors that both hit, solved (pose::solve) with both minima. Their range may be off by percents.
Starts starts_of(const RecentSweeps& recent, const Stations& stations, const Target& target);

/// Position of the body, its attitude taken as known, where at least two stations saw it with both planes within the
/// last 70 ms: least squares of the planes' mean angles. Empty where it does not converge or leaves more than 15 mrad.
std::optional<Vector3> triangulate(const RecentSweeps& recent, const Stations& stations, const Target& target,
                                   const WorldFromBody& near);

}  // namespace pharos::network
