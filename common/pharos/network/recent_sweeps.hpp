// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/ring_buffer.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::network {

/// Sweeps of the last fractions of a second, the oldest first.
inline constexpr std::size_t kRecentSweeps = 48;
using RecentSweeps = RingBuffer<PlaneSweep, kRecentSweeps>;
/// Some of them, where they lie: a sweep has room for 64 hits.
using SweepView = StaticVector<const PlaneSweep*, kRecentSweeps>;

}  // namespace pharos::network
