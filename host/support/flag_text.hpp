// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "pharos/base/flag_word.hpp"

namespace pharos::host {

/// The words of the bits set, joined by `|`.
inline std::string joined_flags(unsigned flags, std::span<const FlagWord> words) {
  std::string text;
  for (const FlagWord& flag : words) {
    if ((flags & flag.bit) == 0) continue;
    if (!text.empty()) text += '|';
    text += flag.word;
  }
  return text;
}

}  // namespace pharos::host
