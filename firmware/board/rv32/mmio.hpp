// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::board {

// A device register at an address: every read and write happens, in order.
inline volatile std::uint32_t& mmio32(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
inline volatile std::uint16_t& mmio16(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}
inline volatile std::uint8_t& mmio8(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}

}  // namespace pharos::board
