// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/unknowns.hpp"

namespace pharos::tools {

/// SENSOR,SENSOR,METRES,SIGMA. Throws InputError saying what is wrong with it.
calibrate::MeasuredLength parse_length(const std::string& text);

}  // namespace pharos::tools
