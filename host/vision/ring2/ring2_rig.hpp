// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/cameras/rig_file.hpp"
#include "pharos/ring2/rig.hpp"

namespace pharos::host {

/// Converts the rig of a rig file to the core's type.
inline ring2::Rig ring2_rig(const RigFile& file) {
  return {{{{file.left.intrinsics, file.left.pose()}, {file.right.intrinsics, file.right.pose()}}}};
}

}  // namespace pharos::host
