// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/pose/solve.hpp"

namespace pharos::pose {

/// Same result as solve() with this prior, in integers: for cores without a floating-point unit.
///
/// Both minima, covariance and precision factors by the same rules (minima.hpp), the pose within 0.1 sigma of that of
/// solve(). Empty where solve() is needed: hits that compete or contradict the rigid body, too few sensors, a prior
/// farther than 1/8 rad from the bearings, a view too near to singular for 30 bits, correlated noise. Cost on RV32IM
/// with 8 sensors: some 80,000 instructions; 2.5 KiB of stack.
std::optional<Solution> solve_warm(const Target& target, const Observations& observations, const SolveOptions& options,
                                   const LighthouseFromBody& prior);

}  // namespace pharos::pose
