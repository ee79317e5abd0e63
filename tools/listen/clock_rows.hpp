// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos {
class clock_exchange_t;
}

namespace pharos::tools {

/// A line of text: which daemon asks which one for its clock, or answers.
std::string clock_line(const clock_exchange_t& exchange);
/// The whole message as one JSON object; times of a question are null.
std::string clock_json(const clock_exchange_t& exchange);

}  // namespace pharos::tools
