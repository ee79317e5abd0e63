// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered satellites in front of a telescope, measured as by `pharos line`.
IntegrityKind pointing_kind();

}  // namespace pharos::tools
