// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/printf_text.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace pharos::tools {

std::string printf_text(const char* format, ...) {
  std::array<char, 500> out{};
  std::va_list arguments;
  va_start(arguments, format);
  // The analyser does not see va_start here.
  std::vsnprintf(out.data(), out.size(), format, arguments);  // NOLINT(clang-analyzer-valist.Uninitialized)
  va_end(arguments);
  return out.data();
}

}  // namespace pharos::tools
