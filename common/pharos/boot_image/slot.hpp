// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/boot_image/boot_image_header.hpp"

namespace pharos::boot_image {

// A slot is a part of NOR flash that holds one image as it lies in its file, and in its first page, behind the header,
// the mark. Everything is written before the header and the header before the mark, so a mark stands only on a slot
// whose every byte was verified. NOR flash only turns ones into zeros and power may go at any bit of it: that mark and
// header belong together and are whole is told by CRCs, never by a single bit.

/// Two: one keeps what ran last while the other is written.
inline constexpr std::size_t kSlots = 2;

/// Which of two whole images is the newer one.
struct SlotMark {
  std::uint32_t sequence;  // from 1 on, one more each time: no flash lives to see it wrap
  std::uint32_t check;     // CRC-32 of `sequence`, going on from the header's
};

SlotMark make_mark(const BootImageHeader& header, std::uint32_t sequence);

/// What must be read of a slot to know what it says, as it lies there.
struct SlotHead {
  BootImageHeader header;
  SlotMark mark;
};
static_assert(sizeof(SlotHead) == 72);

/// The slot's sequence number; 0 when there is no header or mark, or one that was not written to its end. The greater
/// one is to be tried first. The body is still to be checked.
std::uint32_t sequence_of(const SlotHead& head);

}  // namespace pharos::boot_image
