// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::tools {

/// printf into a string of up to 500 characters; the compiler checks the arguments.
[[gnu::format(printf, 1, 2)]] std::string printf_text(const char* format, ...);

}  // namespace pharos::tools
