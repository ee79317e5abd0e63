// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class pointing_t;
}

namespace pharos::tools {

/// A line for people: elevation and azimuth of the axis, and how well it and the plane that holds it are known.
std::string pointing_line(const pointing_t& pointing);
/// The whole message as one JSON object; what a refused image does not tell is null.
std::string pointing_json(const pointing_t& pointing);

}  // namespace pharos::tools
