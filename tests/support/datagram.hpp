// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pharos::test {

using Datagram = std::vector<std::uint8_t>;

/// Appends the lowest `count` bytes of a number, the highest first, as networks do.
inline void put(Datagram& bytes, std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

}  // namespace pharos::test
