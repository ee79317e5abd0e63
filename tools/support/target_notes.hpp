// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/geometry/target.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// Notes on standard error what a target's shape means for its poses, where the user should know it.
inline void note_target_shape(const std::string& path, const TargetShape& shape) {
  if (shape.coplanar) {
    note(path + ": all sensors lie in one plane: some cycles fit two poses (status ambiguous)");
  }
}

}  // namespace pharos::tools
