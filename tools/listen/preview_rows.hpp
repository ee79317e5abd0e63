// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class preview_t;
}

namespace pharos::tools {

/// A line of text: whose picture it is, the image's size and the picture's.
std::string preview_line(const preview_t& preview);
/// The whole message but its picture as one JSON object.
std::string preview_json(const preview_t& preview);

}  // namespace pharos::tools
