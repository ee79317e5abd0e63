// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered pairs of docking ring and nozzle, measured as by `pharos circles`.
IntegrityKind ring2_kind();

}  // namespace pharos::tools
