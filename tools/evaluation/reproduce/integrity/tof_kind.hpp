// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered satellites before a depth camera through the whole of `pharos tof`.
IntegrityKind tof_kind();

}  // namespace pharos::tools
