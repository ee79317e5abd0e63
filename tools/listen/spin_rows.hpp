// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class spin_t;
}

namespace pharos::tools {

/// A line for people: rate and axis of a target's turning, and how well they are known.
std::string spin_line(const spin_t& spin);
/// The whole message as one JSON object; what a refused one does not tell is null.
std::string spin_json(const spin_t& spin);

}  // namespace pharos::tools
