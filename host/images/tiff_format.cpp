// SPDX-License-Identifier: Apache-2.0
#include "host/images/tiff_format.hpp"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "host/images/limits.hpp"
#include "host/images/samples.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using Bytes = std::span<const std::uint8_t>;

// LZW has the highest compression: a code of 12 bits for at most 4094 bytes. A larger declared size is refused before
// memory is allocated.
constexpr std::size_t kMaxPacking = 4096;

// A file in memory, and libtiff's first message about it. libtiff writes nothing to standard error.
struct Source {
  Bytes bytes;
  std::size_t at = 0;
  std::string error;
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t take(thandle_t handle, void* out, tmsize_t wanted) {
  Source& source = source_of(handle);
  const std::size_t left = source.bytes.size() - std::min(source.at, source.bytes.size());
  const std::size_t count = std::min(left, static_cast<std::size_t>(std::max<tmsize_t>(wanted, 0)));
  if (count > 0) std::memcpy(out, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t give(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = source_of(handle);
  const std::size_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? source.at : source.bytes.size();
  source.at = from + offset;
  return source.at;
}

int keep_open(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return source_of(handle).bytes.size(); }

int map(thandle_t handle, void** base, toff_t* size) {
  // libtiff does not write to mapped memory: it copies where it must reverse bits.
  *base = const_cast<std::uint8_t*>(source_of(handle).bytes.data());
  *size = source_of(handle).bytes.size();
  return 1;
}
void unmap(thandle_t, void*, toff_t) {}

[[gnu::format(printf, 4, 0)]] int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  Source& source = *static_cast<Source*>(user);
  if (!source.error.empty()) return 1;
  std::array<char, 160> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  source.error = text.data();
  // Makes one line of the message, whatever bytes of the file it quotes.
  for (char& letter : source.error) letter = letter >= ' ' && letter <= '~' ? letter : '?';
  return 1;
}

// Most warnings are about unknown tags and harmless. The JPEG decoder fills in missing data and warns.
[[gnu::format(printf, 4, 0)]] int on_warning(TIFF* tiff, void* user, const char* module, const char* format,
                                             va_list arguments) {
  return module != nullptr && std::string_view(module) == "JPEGLib" ? on_error(tiff, user, module, format, arguments)
                                                                    : 1;
}

struct Close {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, Close>;

Tiff opened(Source& source) {
  struct Free {
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
  };
  const std::unique_ptr<TIFFOpenOptions, Free> options(TIFFOpenOptionsAlloc());
  if (!options) return nullptr;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(kMaxDecodedBytes));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &source);
  return Tiff(TIFFClientOpenExt("", "r", &source, take, give, seek, keep_open, size_of, map, unmap, options.get()));
}

template <class Number>
Number field(const Tiff& tiff, std::uint32_t tag, Number otherwise) {
  Number value{};
  return TIFFGetFieldDefaulted(tiff.get(), tag, &value) == 1 ? value : otherwise;
}

struct TiffLayout {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, photometric = 0, compression = 0;
  bool apart = false;  // planar configuration: each colour in a plane of its own

  std::size_t colours() const { return photometric == PHOTOMETRIC_RGB ? 3 : 1; }
  std::size_t value_bytes() const { return bits / 8; }
  std::size_t values() const { return std::size_t{width} * height * samples; }
};

[[noreturn]] void refuse_kind(const std::string& name, const std::string& what, const char* remedy) {
  throw InputError(name + ": is a TIFF " + what + "; " + remedy);
}

TiffLayout layout_of(const Tiff& tiff, const std::string& name) {
  TiffLayout layout;
  layout.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  layout.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  require_readable_size(layout.width, layout.height, name);
  layout.bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  layout.samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  layout.compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  layout.apart = field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
  layout.photometric =
      field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, layout.samples < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  return layout;
}

void check_kind(const Tiff& tiff, TiffLayout& layout, const std::string& name) {
  constexpr std::array kCompressions = {COMPRESSION_NONE,    COMPRESSION_PACKBITS,      COMPRESSION_LZW,
                                        COMPRESSION_DEFLATE, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_JPEG};
  if (std::find(kCompressions.begin(), kCompressions.end(), layout.compression) == kCompressions.end()) {
    refuse_kind(name, "of compression " + std::to_string(layout.compression),
                "plain, PackBits, LZW, Deflate and JPEG are read (convert IN -compress zip OUT)");
  }
  if (layout.compression == COMPRESSION_JPEG && layout.photometric == PHOTOMETRIC_YCBCR && !layout.apart) {
    TIFFSetField(tiff.get(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    layout.photometric = PHOTOMETRIC_RGB;
  }
  constexpr std::array kColours = {PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_RGB,
                                   PHOTOMETRIC_PALETTE};
  if (std::find(kColours.begin(), kColours.end(), layout.photometric) == kColours.end()) {
    refuse_kind(name, "of colour space " + std::to_string(layout.photometric),
                "grey, palette and red, green, blue are read (convert IN -colorspace sRGB OUT)");
  }
  const auto format = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const bool whole_numbers = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID;
  const bool palette = layout.photometric == PHOTOMETRIC_PALETTE;
  if (!whole_numbers || (layout.bits != 8 && (layout.bits != 16 || palette))) {
    refuse_kind(name,
                "of " + std::to_string(layout.bits) + (whole_numbers ? "" : " signed or floating-point") + " bits",
                "unsigned values of 8 or 16 bits (palette: 8) are read (convert IN -depth 16 OUT)");
  }
  if (layout.samples < layout.colours() || layout.samples > layout.colours() + 1) {
    refuse_kind(name, "of " + std::to_string(layout.samples) + " values a pixel",
                "1 or 3 and an opacity are read (convert IN -alpha off OUT)");
  }
}

// The image in the units of the file: strips over its full width, or tiles.
struct Pieces {
  std::uint32_t width = 0, height = 0, across = 0, down = 0;
  std::size_t bytes = 0;  // of one, decoded
  bool tiles = false;
};

Pieces pieces_of(const Tiff& tiff, const TiffLayout& layout, const std::string& name) {
  Pieces pieces;
  pieces.tiles = TIFFIsTiled(tiff.get()) != 0;
  const auto up = [](std::uint32_t all, std::uint32_t part) { return (all - 1) / part + 1; };
  if (pieces.tiles) {
    pieces.width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
    pieces.height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
  } else {
    pieces.width = layout.width;
    pieces.height = std::min(field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, layout.height), layout.height);
  }
  const std::size_t samples = layout.apart ? 1 : layout.samples;
  if (pieces.width == 0 || pieces.height == 0) refuse_damaged(name, "TIFF", "strips or tiles of no size");
  pieces.across = up(layout.width, pieces.width);
  pieces.down = up(layout.height, pieces.height);
  const tmsize_t size = pieces.tiles ? TIFFTileSize(tiff.get()) : TIFFStripSize(tiff.get());
  pieces.bytes = static_cast<std::size_t>(std::max<tmsize_t>(size, 0));
  // Tiles may extend beyond the image, but not by more than its size: else small files would cost much time.
  const std::size_t count = std::size_t{pieces.across} * pieces.down * (layout.apart ? layout.samples : 1);
  const std::size_t wanted = std::size_t{pieces.width} * pieces.height * samples * layout.value_bytes();
  if (pieces.bytes != wanted || pieces.bytes > kMaxDecodedBytes || count > 2 * kMaxDecodedBytes / pieces.bytes) {
    refuse_damaged(
        name, "TIFF",
        "strips or tiles of " + std::to_string(pieces.width) + " x " + std::to_string(pieces.height) + " pixels");
  }
  return pieces;
}

class TiffPixels {
 public:
  TiffPixels(const Tiff& tiff, const Source& source, const TiffLayout& layout, const std::string& name)
      : tiff_(tiff), source_(source), layout_(layout), pieces_(pieces_of(tiff, layout, name)), name_(name) {
    const std::size_t packing = layout.compression == COMPRESSION_NONE ? 1 : kMaxPacking;
    if (layout.values() * layout.value_bytes() > packing * source.bytes.size()) {
      refuse_damaged(name, "TIFF", kLessData);
    }
  }

  std::vector<std::uint16_t> read() {
    values_.resize(layout_.values());
    piece_.resize(pieces_.bytes);
    for (std::size_t plane = 0; plane < (layout_.apart ? layout_.samples : 1U); ++plane) {
      for (std::uint32_t y = 0; y < pieces_.down; ++y) {
        for (std::uint32_t x = 0; x < pieces_.across; ++x) read_piece(plane, x, y);
      }
    }
    return std::move(values_);
  }

 private:
  void read_piece(std::size_t plane, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t u = x * pieces_.width, v = y * pieces_.height;
    const std::uint32_t columns = std::min(pieces_.width, layout_.width - u);
    const std::uint32_t rows = std::min(pieces_.height, layout_.height - v);
    const std::size_t row_bytes = pieces_.bytes / pieces_.height;
    const std::size_t wanted = pieces_.tiles ? pieces_.bytes : rows * row_bytes;
    const auto index = static_cast<std::uint32_t>((plane * pieces_.down + y) * pieces_.across + x);
    const auto size = static_cast<tmsize_t>(wanted);
    const tmsize_t got = pieces_.tiles ? TIFFReadEncodedTile(tiff_.get(), index, piece_.data(), size)
                                       : TIFFReadEncodedStrip(tiff_.get(), index, piece_.data(), size);
    if (got != size || !source_.error.empty()) {
      refuse_damaged(name_, "TIFF", source_.error.empty() ? kLessData : source_.error);
    }
    const std::size_t together = layout_.apart ? 1 : layout_.samples;
    for (std::uint32_t row = 0; row < rows; ++row) {
      const std::size_t first = (std::size_t{v} + row) * layout_.width + u;
      copy_row(piece_.data() + row * row_bytes, columns * together, &values_[first * layout_.samples + plane],
               layout_.apart ? layout_.samples : 1U);
    }
  }

  void copy_row(const std::uint8_t* from, std::size_t count, std::uint16_t* to, std::size_t step) const {
    if (layout_.bits == 8) {
      for (std::size_t k = 0; k < count; ++k) to[k * step] = static_cast<std::uint16_t>(from[k] * 257);
      return;
    }
    for (std::size_t k = 0; k < count; ++k) std::memcpy(to + k * step, from + 2 * k, 2);
  }

  const Tiff& tiff_;
  const Source& source_;
  const TiffLayout& layout_;
  Pieces pieces_;
  const std::string& name_;
  std::vector<std::uint16_t> values_;
  std::vector<std::uint8_t> piece_;
};

// 256 colours of 16 bits; some programs write values of 8 bits into them.
std::vector<PaletteEntry> palette_of(const Tiff& tiff, const std::string& name) {
  constexpr std::size_t kEntries = 256;
  std::array<std::uint16_t*, 3> colours{};
  if (TIFFGetField(tiff.get(), TIFFTAG_COLORMAP, &colours[0], &colours[1], &colours[2]) != 1) {
    refuse_damaged(name, "TIFF", "no palette");
  }
  std::uint16_t maximum = 0;
  for (const std::uint16_t* colour : colours) maximum = std::max(maximum, *std::max_element(colour, colour + kEntries));
  const int shift = maximum < 256 ? 0 : 8;
  std::vector<PaletteEntry> palette;
  for (std::size_t k = 0; k < kEntries; ++k) {
    const auto part = [&](std::size_t c) { return static_cast<std::uint8_t>(colours[c][k] >> shift); };
    palette.push_back({part(0), part(1), part(2)});
  }
  return palette;
}

void look_up(Picture& picture, const Tiff& tiff, const std::string& name) {
  std::vector<std::uint8_t> indices;
  indices.reserve(picture.values.size());
  for (const std::uint16_t value : picture.values) indices.push_back(static_cast<std::uint8_t>(value >> 8));
  apply_palette(picture, indices, palette_of(tiff, name), name, "TIFF");
}

}  // namespace

bool is_tiff(Bytes bytes) {
  if (bytes.size() < 4) return false;
  const bool little = bytes[0] == 'I' && bytes[1] == 'I' && (bytes[2] == 42 || bytes[2] == 43) && bytes[3] == 0;
  const bool big = bytes[0] == 'M' && bytes[1] == 'M' && bytes[2] == 0 && (bytes[3] == 42 || bytes[3] == 43);
  return little || big;
}

Picture decode_tiff(Bytes bytes, const std::string& name) {
  Source source{bytes, 0, {}};
  const Tiff tiff = opened(source);
  if (!tiff) refuse_damaged(name, "TIFF", source.error.empty() ? "no image in it" : source.error);
  TiffLayout layout = layout_of(tiff, name);
  check_kind(tiff, layout, name);
  source.error.clear();  // about tags that are not used
  Picture picture{static_cast<std::int32_t>(layout.width), static_cast<std::int32_t>(layout.height),
                  static_cast<int>(layout.colours()), layout.bits, TiffPixels(tiff, source, layout, name).read()};
  if (layout.samples > layout.colours()) drop_opacity(picture, name);
  if (layout.photometric == PHOTOMETRIC_PALETTE) look_up(picture, tiff, name);
  if (layout.photometric == PHOTOMETRIC_MINISWHITE) {
    for (std::uint16_t& value : picture.values) value = static_cast<std::uint16_t>(65535 - value);
  }
  return picture;
}

}  // namespace pharos::host
