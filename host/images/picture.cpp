// SPDX-License-Identifier: Apache-2.0
#include "host/images/picture.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "host/images/bmp_format.hpp"
#include "host/images/jpeg_format.hpp"
#include "host/images/png_format.hpp"
#include "host/images/pnm_format.hpp"
#include "host/images/tiff_format.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

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
    if (size > kMaxImageFileBytes) throw InputError(name + ": larger than any image that is read; scale it down");
    if (got == 0) {
      bytes.resize(size);
      return bytes;
    }
  }
}

}  // namespace

Picture decode_picture(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (is_png(bytes)) return decode_png(bytes, name);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name);
  if (is_tiff(bytes)) return decode_tiff(bytes, name);
  if (is_pnm(bytes)) return decode_pnm(bytes, name);
  if (is_bmp(bytes)) return decode_bmp(bytes, name);
  if (bytes.empty()) throw InputError(name + ": is empty; a PNG, TIFF, JPEG, BMP, PGM or PPM is needed");
  throw InputError(name + ": is no PNG, TIFF, JPEG, BMP and no binary PGM or PPM; convert it to one of them");
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
