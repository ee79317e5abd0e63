// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "pharos/base/result.hpp"

namespace pharos::boot_image {

// An image file is one page with header and seal, then the body: the bytes that are copied to `load_address`. The page
// has the size of one NOR flash programming operation, so that the header can be written last.

/// Bytes before the body: the header, and FF to the end of the page.
inline constexpr std::size_t kPageBytes = 256;
/// Distinguishes images of this and other formats: the header's `format`.
inline constexpr std::uint8_t kFormat = 2;
inline constexpr std::uint32_t kMagic = 0x474D4950;  // "PIMG"

struct Version {
  std::uint8_t major;
  std::uint8_t minor;
  std::uint8_t patch;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the comparison's zero for a pointer.
  auto operator<=>(const Version&) const = default;
};

/// The header of an image, laid out as in the file (README.md): little-endian, no padding. No initial values: the
/// loader has no memory to spare for them.
struct BootImageHeader {
  std::uint32_t magic;
  std::uint32_t body_bytes;  // a multiple of 4, at least 4
  std::uint32_t body_crc32;
  std::uint32_t load_address;   // where the body is copied to, a multiple of 4
  std::uint32_t entry_address;  // first instruction, within the body, a multiple of 4
  std::uint8_t format;
  Version version;
  std::array<char, 24> board;  // the target board, printable ASCII padded with zeros
  std::array<char, 12> name;   // its program: "decoder_pose"
  std::uint32_t header_crc32;  // of all before it
};
static_assert(sizeof(BootImageHeader) == 64 && std::is_trivial_v<BootImageHeader>);

/// After the header, in a file and in a slot.
struct Seal {
  std::array<std::uint8_t, 32> body_sha256;
  /// Ed25519, of the header's 64 bytes and the 32 of the digest; all FF: not signed.
  std::array<std::uint8_t, 64> signature;
};
/// Header and seal together, without padding: the front of every image.
struct SealedHeader {
  BootImageHeader header;
  Seal seal;
};
static_assert(sizeof(SealedHeader) == 160 && std::is_trivial_v<SealedHeader>);
static_assert(std::endian::native == std::endian::little, "images are read as they lie in memory");

/// Why bytes are not a valid image.
enum class BootImageError : std::uint8_t {
  kNone,
  kCutShort,     // fewer bytes than the header states, or no whole header
  kNoImage,      // something else: the magic number is not there
  kOtherFormat,  // another format than this program supports
  kBadHeader,    // the header's CRC is wrong, or a field is invalid
  kTooLong,      // bytes after the body
  kBadBody,      // the body's CRC or SHA-256 is wrong
};

/// Checks a header as read, without its texts: kNoImage, kOtherFormat, kBadHeader or kNone. For callers with little
/// memory.
BootImageError fault_of(const BootImageHeader& header);

/// The header at the front of `page` (at least its 64 bytes), when it is whole and every field is valid. The body is
/// not checked.
Result<BootImageHeader, BootImageError> read_header(std::span<const std::uint8_t> page);

/// The header that `body` needs: magic, format, length and both CRCs filled in.
BootImageHeader sealed(BootImageHeader header, std::span<const std::uint8_t> body);

/// Whether there is a signature; not whether it is good. The last byte of a good one is below 0x20 (RFC 8032: S is
/// below 2^253), so FF there is none.
inline bool is_signed(const Seal& seal) { return seal.signature.back() != 0xFF; }

/// What a signature is of: valid as long as `head`.
inline std::span<const std::uint8_t, 96> signed_bytes_of(const SealedHeader& head) {
  return std::span<const std::uint8_t, 96>(reinterpret_cast<const std::uint8_t*>(&head), 96);
}

/// A whole image file: header, page and body in their form. Not the signature: the target has the key. Cost: a CRC and
/// a SHA-256 over all of it.
Result<BootImageHeader, BootImageError> check_image(std::span<const std::uint8_t> file);

/// The header as its bytes; valid as long as it.
inline std::span<const std::uint8_t, sizeof(BootImageHeader)> bytes_of(const BootImageHeader& header) {
  return std::span<const std::uint8_t, sizeof(BootImageHeader)>(reinterpret_cast<const std::uint8_t*>(&header),
                                                                sizeof header);
}

}  // namespace pharos::boot_image
