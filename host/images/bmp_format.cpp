// SPDX-License-Identifier: Apache-2.0
#include "host/images/bmp_format.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/images/limits.hpp"
#include "host/images/samples.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kFileHeader = 14, kCoreHeader = 12, kInfoHeader = 40, kMasksEnd = 52, kOpacityMaskEnd = 56;
constexpr std::uint32_t kPlain = 0, kBitfields = 3, kBitfieldsWithOpacity = 6;
constexpr std::array<std::uint32_t, 3> kPlainMasks = {0xFF0000, 0xFF00, 0xFF};  // red, green, blue

// Little-endian numbers at offsets that may be beyond the end.
class Numbers {
 public:
  Numbers(Bytes bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::uint32_t u16(std::size_t at) const { return number(at, 2); }
  std::uint32_t u32(std::size_t at) const { return number(at, 4); }

 private:
  std::uint32_t number(std::size_t at, std::size_t count) const {
    if (at + count > bytes_.size()) refuse_damaged(name_, "BMP", "the header ends too soon");
    std::uint32_t value = 0;
    for (std::size_t k = count; k-- > 0;) value = value << 8 | bytes_[at + k];
    return value;
  }
  Bytes bytes_;
  const std::string& name_;
};

struct Header {
  std::size_t size = 0;  // of the header after the file's
  std::int64_t width = 0, height = 0;
  bool downwards = false;
  std::uint32_t bits = 0, compression = kPlain, colours_used = 0;
  std::array<std::uint32_t, 3> masks = kPlainMasks;
  std::uint32_t opacity_mask = 0;
  std::size_t data = 0;  // where the rows begin

  bool core() const { return size == kCoreHeader; }
  std::size_t masks_behind() const {  // of a header that contains none itself
    if (size != kInfoHeader) return 0;
    return compression == kBitfields ? 12 : compression == kBitfieldsWithOpacity ? 16 : 0;
  }
  std::size_t pixel_bytes() const { return bits / 8; }
  std::size_t row_bytes() const { return (static_cast<std::size_t>(width) * pixel_bytes() + 3) / 4 * 4; }
};

void read_masks(const Numbers& numbers, Header& header) {
  if (header.compression == kPlain) return;
  for (std::size_t k = 0; k < 3; ++k) header.masks[k] = numbers.u32(kFileHeader + kInfoHeader + 4 * k);
  const bool within = header.size >= kOpacityMaskEnd || header.compression == kBitfieldsWithOpacity;
  if (within) header.opacity_mask = numbers.u32(kFileHeader + kMasksEnd);
}

Header read_header(Bytes bytes, const std::string& name) {
  const Numbers numbers(bytes, name);
  Header header;
  header.data = numbers.u32(10);
  header.size = numbers.u32(kFileHeader);
  if (header.core()) {
    header.width = numbers.u16(18);
    header.height = numbers.u16(20);
    header.bits = numbers.u16(24);
    return header;
  }
  constexpr std::array<std::size_t, 6> kSizes = {kInfoHeader, kMasksEnd, kOpacityMaskEnd, 64, 108, 124};
  if (std::find(kSizes.begin(), kSizes.end(), header.size) == kSizes.end()) {
    refuse_damaged(name, "BMP", "a header of " + std::to_string(header.size) + " bytes");
  }
  header.width = static_cast<std::int32_t>(numbers.u32(18));
  header.height = static_cast<std::int32_t>(numbers.u32(22));
  header.downwards = header.height < 0;
  if (header.downwards) header.height = -header.height;
  header.bits = numbers.u16(28);
  header.compression = numbers.u32(30);
  header.colours_used = numbers.u32(46);
  if (header.size != 64) read_masks(numbers, header);  // 64: OS/2 2.x, whose compression codes differ
  return header;
}

void check(const Header& header, const std::string& name) {
  if (header.width < 0) refuse_damaged(name, "BMP", "a width below zero");
  require_readable_size(static_cast<std::size_t>(header.width), static_cast<std::size_t>(header.height), name);
  const bool bits = header.bits == 8 || header.bits == 24 || header.bits == 32;
  const bool masked = header.bits == 32 && header.size != 64 &&
                      (header.compression == kBitfields || header.compression == kBitfieldsWithOpacity);
  if (!bits || (header.compression != kPlain && !masked)) {
    throw InputError(name + ": is a BMP of " + std::to_string(header.bits) + " bits, compression " +
                     std::to_string(header.compression) +
                     "; uncompressed ones of 8, 24 and 32 are read: save it as PNG (convert IN OUT.png)");
  }
}

// Position of a colour within a pixel's four bytes.
std::size_t byte_of(std::uint32_t mask, const std::string& name) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (mask == std::uint32_t{0xFF} << (8 * k)) return k;
  }
  throw InputError(name + ": is a BMP whose colours are not of 8 bits; save it as PNG (convert IN OUT.png)");
}

std::vector<PaletteEntry> palette_of(Bytes bytes, const Header& header) {
  const std::size_t begin = kFileHeader + header.size + header.masks_behind();
  const std::size_t entry = header.core() ? 3 : 4;
  const std::size_t end = std::min(header.data, bytes.size());
  std::size_t count = header.colours_used == 0 ? 256 : std::min<std::size_t>(header.colours_used, 256);
  count = end > begin ? std::min(count, (end - begin) / entry) : 0;
  std::vector<PaletteEntry> palette;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = begin + k * entry;
    palette.push_back({bytes[at + 2], bytes[at + 1], bytes[at]});
  }
  return palette;
}

// The values of each pixel from the file's bytes at the offsets `places`, rows downwards.
std::vector<std::uint8_t> values_of(Bytes bytes, const Header& header, std::span<const std::size_t> places) {
  std::vector<std::uint8_t> values;
  values.reserve(static_cast<std::size_t>(header.width * header.height) * places.size());
  for (std::int64_t v = 0; v < header.height; ++v) {
    const auto row = static_cast<std::size_t>(header.downwards ? v : header.height - 1 - v);
    const std::uint8_t* pixel = bytes.data() + header.data + row * header.row_bytes();
    for (std::int64_t u = 0; u < header.width; ++u, pixel += header.pixel_bytes()) {
      for (const std::size_t place : places) values.push_back(pixel[place]);
    }
  }
  return values;
}

}  // namespace

bool is_bmp(Bytes bytes) { return bytes.size() >= 2 && bytes[0] == 'B' && bytes[1] == 'M'; }

Picture decode_bmp(Bytes bytes, const std::string& name) {
  const Header header = read_header(bytes, name);
  check(header, name);
  if (header.data < kFileHeader + header.size) refuse_damaged(name, "BMP", "its pixels begin within its header");
  const std::size_t used = static_cast<std::size_t>(header.width) * header.pixel_bytes();
  const std::size_t needed = header.row_bytes() * static_cast<std::size_t>(header.height - 1) + used;
  if (header.data > bytes.size() || bytes.size() - header.data < needed) refuse_damaged(name, "BMP", kLessData);
  Picture picture{static_cast<std::int32_t>(header.width), static_cast<std::int32_t>(header.height), 3, 8, {}};
  if (header.bits == 8) {
    constexpr std::array<std::size_t, 1> kIndex = {0};
    apply_palette(picture, values_of(bytes, header, kIndex), palette_of(bytes, header), name, "BMP");
    return picture;
  }
  std::vector<std::size_t> places;
  for (const std::uint32_t mask : header.masks) places.push_back(byte_of(mask, name));
  if (header.opacity_mask != 0) places.push_back(byte_of(header.opacity_mask, name));
  picture.values = widened(values_of(bytes, header, places));
  if (header.opacity_mask == 0) return picture;
  // Many programs declare an opacity field and leave it 0 everywhere: unused.
  bool unused = true;
  for (std::size_t k = 3; k < picture.values.size(); k += 4) unused = unused && picture.values[k] == 0;
  for (std::size_t k = 3; unused && k < picture.values.size(); k += 4) picture.values[k] = 65535;
  drop_opacity(picture, name);
  return picture;
}

}  // namespace pharos::host
