// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pharos::hal {

/// Maximum bytes programmed at once, and never across a multiple of it: the page of every serial NOR flash.
inline constexpr std::size_t kFlashPageBytes = 256;

/// NOR flash: erasing sets a whole sector to ones, programming changes ones to zeros. Offsets count from its start;
/// offset and length of every programming are multiples of 4.
///
/// Every call returns when the memory is done. Writing may take seconds, and bytes of the serial line would be lost
/// meanwhile: `idle` is called repeatedly while the memory works, at least once a byte's time on the line. false: the
/// memory reports a failure, or does not respond. Written data is not read back here.
template <class F>
concept Flash = requires(F& flash, std::uint32_t offset, std::span<std::uint8_t> out, std::span<const std::uint8_t> in,
                         void (&idle)()) {
  { F::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  flash.read(offset, out);
  { flash.program(offset, in, idle) } -> std::same_as<bool>;
  { flash.erase_sector(offset, idle) } -> std::same_as<bool>;
};

}  // namespace pharos::hal
