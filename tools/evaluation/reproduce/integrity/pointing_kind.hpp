// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Rendered satellites before a telescope through the whole of `pharos line`.
IntegrityKind pointing_kind();

}  // namespace pharos::tools
