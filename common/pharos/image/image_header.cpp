// SPDX-License-Identifier: Apache-2.0
#include "pharos/image/image_header.hpp"

#include <algorithm>
#include <cstring>

#include "pharos/wire/crc32.hpp"
#include "pharos/wire/text.hpp"

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

bool means_something(const ImageHeader& header) {
  const std::uint32_t aligned = header.body_bytes | header.load_address | header.entry_address;
  return aligned % kAlignment == 0 && header.entry_address - header.load_address < header.body_bytes;
}

}  // namespace

ImageFault fault_of(const ImageHeader& header) {
  if (header.magic != kMagic) return ImageFault::kNoImage;
  if (header.format != kFormat) return ImageFault::kOtherFormat;
  if (header.header_crc32 != crc_of(header) || !means_something(header)) return ImageFault::kBadHeader;
  return ImageFault::kNone;
}

Result<ImageHeader, ImageFault> read_header(std::span<const std::uint8_t> page) {
  if (page.size() < sizeof(ImageHeader)) return ImageFault::kCutShort;
  ImageHeader header;
  std::memcpy(&header, page.data(), sizeof header);
  if (const ImageFault fault = fault_of(header); fault != ImageFault::kNone) return fault;
  if (!is_clean(header.board) || !is_clean(header.name)) return ImageFault::kBadHeader;
  return header;
}

ImageHeader sealed(ImageHeader header, std::span<const std::uint8_t> body) {
  header.magic = kMagic;
  header.format = kFormat;
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
