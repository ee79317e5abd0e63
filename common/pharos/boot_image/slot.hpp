// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/boot_image/boot_image_header.hpp"

namespace pharos::boot_image {

// A slot is a part of NOR flash that holds one image as in its file, and in its first page, after the seal, the mark.
// Everything is written before the header and the header before the mark, so only a slot whose every byte and signature
// was verified has a mark. NOR flash only changes ones to zeros and power may fail at any bit of it: CRCs, never a
// single bit, show that mark and header belong together and are whole.

/// Three: the newest image, the one before it as its fallback, and one that is written: what is refused costs neither.
inline constexpr std::size_t kSlots = 3;

/// Determines the newer of two whole images.
struct SlotMark {
  std::uint32_t sequence;  // even, two more each time: no flash lasts until it wraps
  std::uint32_t check;     // CRC-32 of header, seal and `sequence`
};

SlotMark make_mark(const SealedHeader& image, std::uint32_t sequence);

/// The part of a slot that must be read to check it, as stored.
struct SlotHead {
  SealedHeader image;
  SlotMark mark;
};
static_assert(sizeof(SlotHead) == 168);

/// The slot's sequence number; 0 when there is no header or mark, or one that was not written to its end. The greater
/// one is to be tried first. The body is still to be checked.
std::uint32_t sequence_of(const SlotHead& head);

}  // namespace pharos::boot_image
