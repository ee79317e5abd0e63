// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/bench/edge_drawing.hpp"
#include "tools/evaluation/bench/low_light_peers.hpp"
#include "tools/evaluation/bench/peer_solver.hpp"

namespace pharos::tools {

/// The peers' function from the module beside this program, or null where it was not built (no OpenCV).
PeerFunction load_peers();
/// The same for ellipses.
EdgeDrawingFunction load_edge_drawing();
/// The same for low light.
const LowLightPeers* load_low_light();

}  // namespace pharos::tools
