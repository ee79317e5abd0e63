// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/peer_module.hpp"

#include "host/support/module_function.hpp"

namespace pharos::tools {

PeerFunction load_peers() {
  return reinterpret_cast<PeerFunction>(host::find_module_function(kPeerModuleName, kPeerFunctionName).function);
}

EdgeDrawingFunction load_edge_drawing() {
  return reinterpret_cast<EdgeDrawingFunction>(host::find_module_function(kPeerModuleName, kEdgeDrawingName).function);
}

const LowLightPeers* load_low_light() {
  const auto peers =
      reinterpret_cast<LowLightPeersFunction>(host::find_module_function(kPeerModuleName, kLowLightPeersName).function);
  return peers == nullptr ? nullptr : peers();
}

}  // namespace pharos::tools
