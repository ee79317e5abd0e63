// SPDX-License-Identifier: Apache-2.0
#include "host/images/grey_image.hpp"

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "host/images/png_format.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using Bytes = std::span<const std::uint8_t>;

// No file that can be read is larger: both limits at 16 bits, uncompressed, with room for comments.
constexpr std::size_t kMaxFileBytes = 2 * kMaxImagePixels + (std::size_t{1} << 20);

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

// Header of a binary PGM: numbers between white space and comments (# to the end of the line).
class PgmHeader {
 public:
  explicit PgmHeader(Bytes bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> number() {
    skip_space();
    std::uint32_t value = 0;
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && std::isdigit(bytes_[at_]) != 0; ++at_) {
      value = value * 10 + (bytes_[at_] - '0');
      if (value > 1'000'000'000) return std::nullopt;
    }
    if (at_ == begin) return std::nullopt;
    return value;
  }
  // What follows the one white space after the header.
  Bytes rest() const { return at_ < bytes_.size() ? bytes_.subspan(at_ + 1) : Bytes(); }

 private:
  void skip_space() {
    while (at_ < bytes_.size() && (std::isspace(bytes_[at_]) != 0 || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else {
        ++at_;
      }
    }
  }

  Bytes bytes_;
  std::size_t at_ = 2;  // after "P5"
};

GreyImage decode_pgm(Bytes bytes, const std::string& name) {
  PgmHeader header(bytes);
  const auto width = header.number(), height = header.number(), most = header.number();
  if (!width || !height || !most || *width == 0 || *height == 0 || *most == 0 || *most > 65535) {
    throw InputError(name + ": no PGM header (P5, width, height, greatest value up to 65535)");
  }
  const std::size_t pixels = static_cast<std::size_t>(*width) * *height;
  constexpr auto kMaxSide = static_cast<std::uint32_t>(kMaxImageSide_px);
  if (*width > kMaxSide || *height > kMaxSide || pixels > kMaxImagePixels) {
    throw InputError(name + ": claims " + std::to_string(*width) + " x " + std::to_string(*height) +
                     " pixels; at most " + std::to_string(kMaxImagePixels) + " and " +
                     std::to_string(kMaxImageSide_px) + " a side are read");
  }
  const std::size_t value_bytes = *most > 255 ? 2 : 1;
  const Bytes data = header.rest();
  if (data.size() != pixels * value_bytes) {
    throw InputError(name + ": damaged PGM (" + (data.size() < pixels * value_bytes ? "less" : "more") +
                     " data than its header says); save or copy it again");
  }
  GreyImage image{static_cast<std::int32_t>(*width), static_cast<std::int32_t>(*height), value_bytes == 2 ? 16 : 8, {}};
  image.pixels.resize(pixels);
  for (std::size_t k = 0; k < pixels; ++k) {
    image.pixels[k] = static_cast<std::uint16_t>(value_bytes == 2 ? data[2 * k] << 8 | data[2 * k + 1] : data[k] * 257);
  }
  return image;
}

}  // namespace

GreyImage decode_grey_image(Bytes bytes, const std::string& name) {
  if (is_png(bytes)) return decode_png(bytes, name);
  if (bytes.size() >= 3 && bytes[0] == 'P' && bytes[1] == '5') return decode_pgm(bytes, name);
  if (bytes.empty()) throw InputError(name + ": is empty; a grey PNG or PGM of 8 or 16 bits is needed");
  throw InputError(name + ": is no PNG and no binary PGM; a grey image of 8 or 16 bits is needed");
}

GreyImage read_grey_image(const std::string& path) {
  const std::string name = path == "-" ? "standard input" : path;
  return decode_grey_image(bytes_of(path, name), name);
}

void write_grey_png(const std::string& path, ImageView<const std::uint16_t> image, int bits) {
  std::vector<std::uint8_t> rows;
  rows.reserve(image.pixels() * static_cast<std::size_t>(bits / 8));
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      rows.push_back(static_cast<std::uint8_t>(image.at(u, v) >> 8));
      if (bits == 16) rows.push_back(static_cast<std::uint8_t>(image.at(u, v) & 0xFF));
    }
  }
  write_png(path, image.width_px, image.height_px, bits == 16 ? PngPixels::kGrey16 : PngPixels::kGrey8, rows);
}

}  // namespace pharos::host
