// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::host {

/// Five columns of seven dots, the lowest bit uppermost.
using Letter = std::array<std::uint8_t, 5>;

/// Of printable ASCII; a box for anything else.
const Letter& letter_of(char character);

}  // namespace pharos::host
