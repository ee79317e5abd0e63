// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos {

/// A bit of a set of flags and the word that tables and messages have for it. Words are joined by `|`.
struct FlagWord {
  std::uint8_t bit = 0;
  const char* word = "";
};

}  // namespace pharos
