// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class spin_t;
}

namespace pharos::tools {

/// A line of text: rate and axis of a target's rotation, with their sigmas.
std::string spin_line(const spin_t& spin);
/// The whole message as one JSON object; fields without a value in a refusal are null.
std::string spin_json(const spin_t& spin);

}  // namespace pharos::tools
