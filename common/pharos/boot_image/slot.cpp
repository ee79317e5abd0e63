// SPDX-License-Identifier: Apache-2.0
#include "pharos/boot_image/slot.hpp"

#include <span>

#include "pharos/wire/crc32.hpp"

namespace pharos::boot_image {

SlotMark make_mark(const SealedHeader& image, std::uint32_t sequence) {
  const std::span front(reinterpret_cast<const std::uint8_t*>(&image), sizeof image);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(&sequence), sizeof sequence);
  return {.sequence = sequence, .check = wire::crc32(bytes, wire::crc32(front))};
}

std::uint32_t sequence_of(const SlotHead& head) {
  if (fault_of(head.image.header) != BootImageError::kNone) return 0;
  const bool whole = head.mark.check == make_mark(head.image, head.mark.sequence).check;
  return whole ? head.mark.sequence : 0;
}

}  // namespace pharos::boot_image
