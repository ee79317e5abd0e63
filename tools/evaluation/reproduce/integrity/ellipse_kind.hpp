// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {

/// Drawn pictures of dots, rings, cut and hidden ellipses among polygons through the detector of `pharos ellipses`.
IntegrityKind ellipse_kind();

}  // namespace pharos::tools
