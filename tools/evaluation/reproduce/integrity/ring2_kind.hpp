// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered pairs of docking ring and nozzle through the whole of `pharos circles`.
IntegrityKind ring2_kind();

}  // namespace pharos::tools
