// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/mounting/mounting_adjustment.hpp"

namespace pharos::calibrate {

/// Directions of (sensor, feature) whose sigma is more than half of the prior's, as text; and the time offset.
std::vector<std::string> unobservable_directions(const UnknownSource& source, const SourceCovariance& covariance);

}  // namespace pharos::calibrate
