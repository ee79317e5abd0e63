// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::tools {

/// OpenCV's pose solvers that the benchmark runs beside ours.
enum class Peer { kSqpnp, kEpnp, kIterative };

/// A pose from points (x, y, z in turn, body frame, in any unit) and their tangents (x/z, y/z in turn, lighthouse
/// frame); its translation is in that unit. Empty where the peer gives no result.
std::optional<LighthouseFromBody> solve_by_peer(Peer peer, const std::vector<double>& body,
                                                const std::vector<double>& tangents);

}  // namespace pharos::tools
