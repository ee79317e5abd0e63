// SPDX-License-Identifier: Apache-2.0
#include "pharos/boot_image/boot_image_header.hpp"

#include <algorithm>
#include <cstring>

#include "pharos/signature/sha2.hpp"
#include "pharos/wire/crc32.hpp"
#include "pharos/wire/text.hpp"

namespace pharos::boot_image {
namespace {

constexpr std::uint32_t kAlignment = 4;  // of an instruction, and of the loader's copies

std::uint32_t crc_of(const BootImageHeader& header) {
  return wire::crc32(bytes_of(header).first(offsetof(BootImageHeader, header_crc32)));
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

bool means_something(const BootImageHeader& header) {
  const std::uint32_t aligned = header.body_bytes | header.load_address | header.entry_address;
  return aligned % kAlignment == 0 && header.entry_address - header.load_address < header.body_bytes;
}

}  // namespace

BootImageError fault_of(const BootImageHeader& header) {
  if (header.magic != kMagic) return BootImageError::kNoImage;
  if (header.format != kFormat) return BootImageError::kOtherFormat;
  if (header.header_crc32 != crc_of(header) || !means_something(header)) return BootImageError::kBadHeader;
  return BootImageError::kNone;
}

Result<BootImageHeader, BootImageError> read_header(std::span<const std::uint8_t> page) {
  if (page.size() < sizeof(BootImageHeader)) return BootImageError::kCutShort;
  BootImageHeader header;
  std::memcpy(&header, page.data(), sizeof header);
  if (const BootImageError fault = fault_of(header); fault != BootImageError::kNone) return fault;
  if (!is_clean(header.board) || !is_clean(header.name)) return BootImageError::kBadHeader;
  return header;
}

BootImageHeader sealed(BootImageHeader header, std::span<const std::uint8_t> body) {
  header.magic = kMagic;
  header.format = kFormat;
  header.body_bytes = static_cast<std::uint32_t>(body.size());
  header.body_crc32 = wire::crc32(body);
  header.header_crc32 = crc_of(header);
  return header;
}

Result<BootImageHeader, BootImageError> check_image(std::span<const std::uint8_t> file) {
  const auto header = read_header(file);
  if (!header) return header;
  if (file.size() < kPageBytes || file.size() - kPageBytes < header->body_bytes) return BootImageError::kCutShort;
  if (file.size() - kPageBytes > header->body_bytes) return BootImageError::kTooLong;
  const auto rest_of_page = file.first(kPageBytes).subspan(sizeof(SealedHeader));
  if (!std::ranges::all_of(rest_of_page, [](std::uint8_t byte) { return byte == 0xFF; }))
    return BootImageError::kBadHeader;
  SealedHeader head;
  std::memcpy(&head, file.data(), sizeof head);
  const auto body = file.subspan(kPageBytes);
  if (wire::crc32(body) != header->body_crc32 || signature::sha256(body) != head.seal.body_sha256) {
    return BootImageError::kBadBody;
  }
  return header;
}

}  // namespace pharos::boot_image
