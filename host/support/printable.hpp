// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace pharos::host {

/// `text` for a terminal, at most `size` characters: all but printable ASCII as '?'. Whoever can send a message must
/// not send escape sequences or further lines.
inline std::string printable(std::string_view text, std::size_t size = std::string_view::npos) {
  std::string out(text.substr(0, size));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

}  // namespace pharos::host
