// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/target.hpp"

namespace pharos::tools {

/// A target of the class of paper 002, section 4.1: 12 sensors on a frustum within 125 x 125 x 62.5 mm, 4 on the top
/// plate and 2 on each slanted face. (The paper shows its own layout only as a picture.)
Target paper_target();

}  // namespace pharos::tools
