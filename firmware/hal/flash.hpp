// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pharos::hal {

/// What is programmed at once, at most, and never across a multiple of it: the page of every serial NOR flash.
inline constexpr std::size_t kFlashPageBytes = 256;

/// NOR flash: erasing turns a whole sector into ones, programming turns ones into zeros. Offsets count from its start;
/// offset and length are multiples of 4 wherever something is programmed.
///
/// Every call returns when the memory is done. Writing may take seconds, and bytes of the serial line would be lost
/// meanwhile: `idle` is called again and again while the memory works, at least once a byte's time on the line.
/// false: the memory says that it failed, or does not answer. What was written is not read back here.
template <class F>
concept Flash = requires(F& flash, std::uint32_t offset, std::span<std::uint8_t> out, std::span<const std::uint8_t> in,
                         void (&idle)()) {
  { F::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  flash.read(offset, out);
  { flash.program(offset, in, idle) } -> std::same_as<bool>;
  { flash.erase_sector(offset, idle) } -> std::same_as<bool>;
};

}  // namespace pharos::hal
