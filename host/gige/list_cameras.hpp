// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pharos::host {

/// A GigE Vision camera that answered a search.
struct FoundCamera {
  std::string serial, address, vendor, model;
};

/// Cameras that answer on this computer's networks, by address. Takes one second. Cameras of other subnets answer only
/// where the network lets broadcasts through.
std::vector<FoundCamera> list_cameras();

}  // namespace pharos::host
