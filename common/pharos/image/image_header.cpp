// SPDX-License-Identifier: Apache-2.0
#include "pharos/image/image_header.hpp"

#include <algorithm>
#include <cstring>

#include "pharos/wire/crc32.hpp"

namespace pharos::image {
namespace {

constexpr std::uint32_t kAlignment = 4;  // of an instruction, and of what a loader may copy at once

std::uint32_t crc_of(const ImageHeader& header) {
  return wire::crc32(bytes_of(header).first(offsetof(ImageHeader, header_crc32)));
}

/// Printable up to the first zero, zeros from there on.
bool is_clean(std::span<const char> text) {
  bool ended = false;
  for (const char c : text) {
    ended = ended || c == '\0';
    if (ended ? c != '\0' : !wire::Text<1>::is_printable(c)) return false;
  }
  return true;
}

bool is_aligned(std::uint32_t value) { return value % kAlignment == 0; }

bool means_something(const ImageHeader& header) {
  // The body ends below the last address, so that no sum of address and length wraps.
  const std::uint32_t room_above = UINT32_MAX - header.load_address;
  return header.body_bytes > 0 && header.body_bytes <= room_above && is_aligned(header.body_bytes) &&
         is_aligned(header.load_address) && is_aligned(header.entry_address) &&
         header.entry_address - header.load_address < header.body_bytes && is_clean(header.board.characters) &&
         is_clean(header.name.characters);
}

}  // namespace

Result<ImageHeader, ImageFault> read_header(std::span<const std::uint8_t> page) {
  if (page.size() < sizeof(ImageHeader)) return ImageFault::kCutShort;
  ImageHeader header;
  std::memcpy(&header, page.data(), sizeof header);
  if (header.magic != kMagic) return ImageFault::kNoImage;
  if (header.format != kFormat) return ImageFault::kOtherFormat;
  if (header.header_crc32 != crc_of(header) || !means_something(header)) return ImageFault::kBadHeader;
  return header;
}

ImageHeader sealed(ImageHeader header, std::span<const std::uint8_t> body) {
  header.body_bytes = static_cast<std::uint32_t>(body.size());
  header.body_crc32 = wire::crc32(body);
  header.header_crc32 = crc_of(header);
  return header;
}

Result<ImageHeader, ImageFault> check_image(std::span<const std::uint8_t> file) {
  const auto header = read_header(file);
  if (!header) return header;
  if (file.size() < kPageBytes || file.size() - kPageBytes < header->body_bytes) return ImageFault::kCutShort;
  if (file.size() - kPageBytes > header->body_bytes) return ImageFault::kTooLong;
  const auto rest_of_page = file.first(kPageBytes).subspan(sizeof(ImageHeader));
  if (!std::ranges::all_of(rest_of_page, [](std::uint8_t byte) { return byte == 0xFF; })) return ImageFault::kBadHeader;
  if (wire::crc32(file.subspan(kPageBytes)) != header->body_crc32) return ImageFault::kBadBody;
  return header;
}

}  // namespace pharos::image
