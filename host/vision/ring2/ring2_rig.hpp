// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/cameras/rig_file.hpp"
#include "pharos/ring2/rig.hpp"

namespace pharos::host {

/// The rig of a rig file, as the core takes it.
inline ring2::Rig ring2_rig(const RigFile& file) {
  return {{{{file.left.intrinsics, file.left.pose()}, {file.right.intrinsics, file.right.pose()}}}};
}

}  // namespace pharos::host
