// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos {

/// A bit of a set of flags and its word in tables and messages. Words are joined by `|`.
struct FlagWord {
  std::uint8_t bit = 0;
  const char* word = "";
};

}  // namespace pharos
