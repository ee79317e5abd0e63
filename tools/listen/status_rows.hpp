// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class status_t;
}

namespace pharos::tools {

/// A line for the daemon and one for each source; counters that are not zero follow their source.
std::string status_lines(const status_t& status);
/// The whole message as one JSON object.
std::string status_json(const status_t& status);

}  // namespace pharos::tools
