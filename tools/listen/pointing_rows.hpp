// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class pointing_t;
}

namespace pharos::tools {

/// A line of text: elevation and azimuth of the axis, and the sigmas of the axis and of the plane that contains it.
std::string pointing_line(const pointing_t& pointing);
/// The whole message as one JSON object; fields without a value in a refusal are null.
std::string pointing_json(const pointing_t& pointing);

}  // namespace pharos::tools
