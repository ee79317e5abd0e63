// SPDX-License-Identifier: Apache-2.0
#include "pharos/boot_image/slot.hpp"

#include <span>

#include "pharos/wire/crc32.hpp"

namespace pharos::boot_image {

SlotMark make_mark(const BootImageHeader& header, std::uint32_t sequence) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(&sequence), sizeof sequence);
  return {.sequence = sequence, .check = wire::crc32(bytes, header.header_crc32)};
}

std::uint32_t sequence_of(const SlotHead& head) {
  if (fault_of(head.header) != BootImageError::kNone) return 0;
  const bool whole = head.mark.check == make_mark(head.header, head.mark.sequence).check;
  return whole ? head.mark.sequence : 0;
}

}  // namespace pharos::boot_image
