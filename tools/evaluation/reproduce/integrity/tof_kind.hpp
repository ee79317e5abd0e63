// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered satellites in front of a depth camera, measured as by `pharos tof`.
IntegrityKind tof_kind();

}  // namespace pharos::tools
