// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/boot/retained.hpp"
#include "firmware/boot/verifier.hpp"
#include "firmware/hal/flash.hpp"
#include "pharos/boot_image/slot.hpp"

namespace pharos::boot {

/// Ticks of the board's counter, and of every time below.
inline constexpr std::uint32_t kTicksPerSecond = 50'000'000;

/// The loader's interface to a board: there is only one, so a type suffices. Only the flash blocks; start() and
/// restart() do not return.
template <class B>
concept BootBoard = requires(std::uint8_t byte, std::uint32_t address, std::uint32_t bytes,
                             std::span<const std::uint8_t> message, const std::uint8_t* signature) {
  { B::kName } -> std::same_as<const std::array<char, 24>&>;  // padded with zeros
  /// Once, before all else.
  B::prepare();
  requires hal::Flash<typename B::Flash>;
  B::flash();
  /// Offset of a slot in the flash (a multiple of its sector), and the length of each.
  { B::slot_offset(std::size_t{}) } -> std::same_as<std::uint32_t>;
  { B::kSlotBytes } -> std::convertible_to<std::uint32_t>;
  requires B::kSlotBytes % B::Flash::kSectorBytes == 0;
  /// The next byte of the serial line; negative when there is none.
  { B::receive() } -> std::same_as<int>;
  /// Passes a byte to the serial line; false when it does not fit now.
  { B::transmit(byte) } -> std::same_as<bool>;
  { B::ticks() } -> std::same_as<std::uint32_t>;
  /// Memory that an image may be copied to; null where any of it is reserved.
  { B::memory(address, bytes) } -> std::same_as<std::uint8_t*>;
  { B::retained() } -> std::same_as<volatile Retained&>;
  /// Where the floor of versions is recorded: a sector of its own (version_floor.hpp).
  { B::kFloorOffset } -> std::convertible_to<std::uint32_t>;
  /// Whether the jumper is set that allows images without signature.
  { B::development() } -> std::same_as<bool>;
  /// Whether the 64 bytes are a signature of the message with the key of this board. May overwrite memory of images.
  { B::verify(message, signature) } -> std::same_as<Verdict>;
  B::start(address);
  B::restart();
};

}  // namespace pharos::boot
