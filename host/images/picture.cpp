// SPDX-License-Identifier: Apache-2.0
#include "host/images/picture.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "host/images/jpeg_format.hpp"
#include "host/images/png_format.hpp"
#include "host/images/pnm_format.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// No file that can be read is larger: the limit at 16 bits in colour, uncompressed, with room for comments.
constexpr std::size_t kMaxFileBytes = 6 * kMaxImagePixels + (std::size_t{1} << 20);

std::vector<std::uint8_t> bytes_of(const std::string& path, const std::string& name) {
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  const std::unique_ptr<std::FILE, Close> file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(name + ": cannot be read: " + std::strerror(errno));
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  for (std::size_t size = 0;;) {
    bytes.resize(size + kPiece);
    errno = 0;
    const std::size_t got = std::fread(bytes.data() + size, 1, kPiece, file.get());
    size += got;
    if (std::ferror(file.get()) != 0) throw InputError(name + ": cannot be read: " + std::strerror(errno));
    if (size > kMaxFileBytes) throw InputError(name + ": larger than any image that is read");
    if (got == 0) {
      bytes.resize(size);
      return bytes;
    }
  }
}

}  // namespace

void require_readable_size(std::size_t width_px, std::size_t height_px, const std::string& name) {
  constexpr auto kMaxSide = static_cast<std::size_t>(kMaxImageSide_px);
  if (width_px <= kMaxSide && height_px <= kMaxSide && width_px * height_px <= kMaxImagePixels) return;
  throw InputError(name + ": claims " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                   " pixels; at most " + std::to_string(kMaxImagePixels) + " and " + std::to_string(kMaxImageSide_px) +
                   " a side are read");
}

Picture decode_picture(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (is_png(bytes)) return decode_png(bytes, name);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name);
  if (is_pnm(bytes)) return decode_pnm(bytes, name);
  if (bytes.empty()) throw InputError(name + ": is empty; a PNG, JPEG, PGM or PPM is needed");
  throw InputError(name + ": is no PNG, no JPEG and no binary PGM or PPM; convert it to one of them");
}

Picture read_picture(const std::string& path) {
  const std::string name = path == "-" ? "standard input" : path;
  return decode_picture(bytes_of(path, name), name);
}

void write_picture(const std::string& path, const Picture& picture) {
  std::vector<std::uint8_t> rows;
  rows.reserve(picture.values.size() * static_cast<std::size_t>(picture.bits / 8));
  for (const std::uint16_t value : picture.values) {
    rows.push_back(static_cast<std::uint8_t>(value >> 8));
    if (picture.bits == 16) rows.push_back(static_cast<std::uint8_t>(value & 0xFF));
  }
  const bool grey = picture.channels == 1;
  const PngPixels wide = grey ? PngPixels::kGrey16 : PngPixels::kRgb16;
  const PngPixels narrow = grey ? PngPixels::kGrey8 : PngPixels::kRgb8;
  write_png(path, picture.width_px, picture.height_px, picture.bits == 16 ? wide : narrow, rows);
}

}  // namespace pharos::host
