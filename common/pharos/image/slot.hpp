// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "pharos/image/image_header.hpp"

namespace pharos::image {

// A slot is a part of NOR flash that holds one image as it lies in its file, and in its first page, behind the header,
// the mark. Everything is written before the header and the header before the mark, so a mark stands only on a slot
// whose every byte was verified. NOR flash only turns ones into zeros and power may go at any bit of it: that mark and
// header belong together and are whole is told by CRCs, never by a single bit.

/// Two: one keeps what ran last while the other is written.
inline constexpr std::size_t kSlots = 2;

/// Which of two whole images is the newer one. Written once a flashing, from 1 on: no flash lives to see it wrap.
struct SlotMark {
  std::uint32_t sequence = 0;
  std::uint32_t check = 0;  // CRC-32 of `sequence`, going on from the header's
};
inline constexpr std::size_t kMarkOffset = sizeof(ImageHeader);
/// What must be read of a slot to know what it says.
inline constexpr std::size_t kSlotHeadBytes = kMarkOffset + sizeof(SlotMark);

SlotMark make_mark(const ImageHeader& header, std::uint32_t sequence);

/// What a slot says it holds. The body is still to be checked.
struct SlotContent {
  ImageHeader header;
  std::uint32_t sequence = 0;
};

/// Empty when there is no header or mark, or one that was not written to its end.
std::optional<SlotContent> read_slot(std::span<const std::uint8_t, kSlotHeadBytes> head);

using SlotContents = std::array<std::optional<SlotContent>, kSlots>;

/// The slot to be tried first; the other one follows. 0 where neither holds anything.
std::size_t newest(const SlotContents& slots);

}  // namespace pharos::image
