// SPDX-License-Identifier: Apache-2.0
#include "pharos/image/slot.hpp"

#include <bit>
#include <cstring>

#include "pharos/wire/crc32.hpp"

namespace pharos::image {

SlotMark make_mark(const ImageHeader& header, std::uint32_t sequence) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof sequence>>(sequence);
  return {.sequence = sequence, .check = wire::crc32(bytes, header.header_crc32)};
}

std::optional<SlotContent> read_slot(std::span<const std::uint8_t, kSlotHeadBytes> head) {
  const auto header = read_header(head);
  if (!header) return std::nullopt;
  SlotMark mark;
  std::memcpy(&mark, head.data() + kMarkOffset, sizeof mark);
  if (mark.check != make_mark(*header, mark.sequence).check) return std::nullopt;
  return SlotContent{.header = *header, .sequence = mark.sequence};
}

std::size_t newest(const SlotContents& slots) {
  if (!slots[1]) return 0;
  return slots[0] && slots[0]->sequence >= slots[1]->sequence ? 0 : 1;
}

}  // namespace pharos::image
