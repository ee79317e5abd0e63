// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "rtl/chip/chip_device.hpp"

namespace pharos::rtl {

/// A chip, and where its flash has what the loader looks for (firmware/board/<name>/constants.hpp).
struct ChipKind {
  const char* name;
  std::unique_ptr<ChipDevice> (*make)();
  double core_hz;
  std::uint32_t first_slot;
  std::uint32_t verifier;
};
inline constexpr std::array<ChipKind, 2> kChips{
    {{"ep4ce10", &make_chip_device, 50e6, 0x100000, 0x1F0000}, {"up5k", &make_up5k_device, 16e6, 0x40000, 0xF0000}}};

/// The first where there is no such name.
inline const ChipKind& chip_named(const std::string& name) {
  for (const ChipKind& chip : kChips) {
    if (name == chip.name) return chip;
  }
  return kChips.front();
}

}  // namespace pharos::rtl
