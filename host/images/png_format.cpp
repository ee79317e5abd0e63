// SPDX-License-Identifier: Apache-2.0
#include "host/images/png_format.hpp"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "host/files/atomic_file.hpp"
#include "host/images/limits.hpp"
#include "host/images/samples.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
// Deflate compresses to no less than a thousandth: a larger declared size is refused before memory is allocated.
constexpr std::size_t kMaxDeflation = 1100;
// Colour profiles and comments, which are ignored: enough for any profile, too little for a decompression bomb.
constexpr std::size_t kMaxChunkBytes = std::size_t{1} << 24;
constexpr const char* kWrongChunkSize = "the size of a chunk is wrong";
constexpr const char* kEndsTooSoon = "the file ends too soon";

struct Free {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, Free>;

// The format of the decoded pixels from libspng.
struct Layout {
  int format = SPNG_FMT_PNG;
  int channels = 1;  // of colour: 1 or 3
  bool opacity = false;
};

Layout layout_of(const spng_ihdr& header) {
  Layout layout;
  const bool grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
  if (grey && header.bit_depth < 8) layout.format = SPNG_FMT_G8;
  layout.channels = grey || header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ? 1 : 3;
  layout.opacity =
      header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA || header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  return layout;
}

enum class Chunks : std::uint8_t { kComplete, kCut, kWrongSize };

// Whether the sizes lead from chunk to chunk (length, type of four letters, data, check) to the last one: libspng does
// not require it.
Chunks chunks_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHead = 8, kAround = 12;
  const auto is_letter = [](std::uint8_t c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  std::size_t at = kSignature.size();
  while (bytes.size() - at >= kHead) {
    const auto type = bytes.subspan(at + 4, 4);
    if (!std::all_of(type.begin(), type.end(), is_letter)) return Chunks::kWrongSize;
    if (bytes.size() - at < kAround) return Chunks::kCut;
    if (std::equal(type.begin(), type.end(), "IEND")) return Chunks::kComplete;
    std::size_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length = length << 8 | bytes[at + k];
    if (length > bytes.size() - at - kAround) return Chunks::kCut;
    at += length + kAround;
  }
  return Chunks::kCut;
}

class PngReader {
 public:
  PngReader(std::span<const std::uint8_t> bytes, const std::string& name)
      // Each chunk's CRC already covers the bytes of the stream's own checksum.
      : context_(spng_ctx_new(SPNG_CTX_IGNORE_ADLER32)), bytes_(bytes), name_(name) {
    if (!context_) throw InputError(name + ": no memory to read it");
    constexpr std::uint32_t kAny = std::numeric_limits<std::int32_t>::max();
    // Our limits are checked afterwards, with a message that names them.
    spng_set_image_limits(context_.get(), kAny, kAny);
    spng_set_chunk_limits(context_.get(), kMaxChunkBytes, kMaxChunkBytes);
    require(spng_set_png_buffer(context_.get(), bytes.data(), bytes.size()));
    require(spng_get_ihdr(context_.get(), &header_));
    require_readable_size(header_.width, header_.height, name);
  }

  Picture read() {
    Picture picture{static_cast<std::int32_t>(header_.width),
                    static_cast<std::int32_t>(header_.height),
                    1,
                    header_.bit_depth == 16 ? 16 : 8,
                    {}};
    require_enough_bytes(picture.pixels());
    if (header_.color_type == SPNG_COLOR_TYPE_INDEXED) {
      read_palette(picture);
    } else {
      read_values(picture);
    }
    require_chunks();
    return picture;
  }

 private:
  // libspng finds a chunk of a wrong size by the check that it then reads at the wrong place.
  void require(int code) const {
    if (code == 0) return;
    if (code == SPNG_ECHUNK_CRC) require_chunks();
    refuse_damaged(name_, "PNG", spng_strerror(code));
  }

  void require_chunks() const {
    const Chunks chunks = chunks_of(bytes_);
    if (chunks == Chunks::kComplete) return;
    refuse_damaged(name_, "PNG", chunks == Chunks::kCut ? kEndsTooSoon : kWrongChunkSize);
  }

  void require_enough_bytes(std::size_t pixels) const {
    const std::size_t values = header_.color_type == SPNG_COLOR_TYPE_TRUECOLOR ? 3 : 1;
    if (pixels * values * header_.bit_depth / 8 > kMaxDeflation * bytes_.size()) {
      refuse_damaged(name_, "PNG", kLessData);
    }
  }

  std::optional<spng_trns> transparency() {
    spng_trns found{};
    const int code = spng_get_trns(context_.get(), &found);
    if (code == SPNG_ECHUNKAVAIL) return std::nullopt;
    require(code);
    return found;
  }

  void decode(void* out, std::size_t size, int format) {
    require(spng_decode_image(context_.get(), out, size, format, 0));
  }

  void read_values(Picture& picture) {
    const Layout layout = layout_of(header_);
    picture.channels = layout.channels;
    const std::optional<spng_trns> key = transparency();
    const std::size_t values =
        picture.pixels() * (static_cast<std::size_t>(layout.channels) + (layout.opacity ? 1 : 0));
    if (picture.bits == 16) {
      picture.values.resize(values);
      decode(picture.values.data(), 2 * values, layout.format);
    } else {
      const auto narrow = std::make_unique_for_overwrite<std::uint8_t[]>(values);
      decode(narrow.get(), values, layout.format);
      picture.values = widened({narrow.get(), values});
    }
    if (key) refuse_colour_key(picture, *key);
    if (layout.opacity) drop_opacity(picture, name_);
  }

  void read_palette(Picture& picture) {
    spng_plte table{};
    require(spng_get_plte(context_.get(), &table));
    std::vector<PaletteEntry> palette;
    for (std::size_t k = 0; k < table.n_entries; ++k) {
      palette.push_back({table.entries[k].red, table.entries[k].green, table.entries[k].blue});
    }
    const std::optional<spng_trns> opacity = transparency();
    const std::vector<std::uint8_t> indices = unpacked_indices();
    if (opacity) {
      for (const std::uint8_t index : indices) {
        if (index < opacity->n_type3_entries && opacity->type3_alpha[index] != 255) refuse_transparency();
      }
    }
    apply_palette(picture, indices, palette, name_, "PNG");
  }

  // Rows of 1, 2, 4 or 8 bits an index, the first one uppermost in its byte.
  std::vector<std::uint8_t> unpacked_indices() {
    const std::size_t bits = header_.bit_depth, row_bytes = (std::size_t{header_.width} * bits + 7) / 8;
    std::vector<std::uint8_t> packed(row_bytes * header_.height);
    decode(packed.data(), packed.size(), SPNG_FMT_PNG);
    if (bits == 8) return packed;
    std::vector<std::uint8_t> indices;
    indices.reserve(std::size_t{header_.width} * header_.height);
    for (std::size_t v = 0; v < header_.height; ++v) {
      for (std::size_t u = 0; u < header_.width; ++u) {
        const std::size_t bit = u * bits;
        const unsigned byte = packed[v * row_bytes + bit / 8];
        indices.push_back(static_cast<std::uint8_t>(byte >> (8 - bits - bit % 8) & ((1U << bits) - 1)));
      }
    }
    return indices;
  }

  [[noreturn]] void refuse_transparency() const {
    throw InputError(name_ + ": has transparency; an image without is needed (convert IN -alpha off OUT)");
  }

  // One grey value or colour marks transparency: accepted where no pixel has it.
  void refuse_colour_key(const Picture& picture, const spng_trns& key) const {
    const int maximum = (1 << header_.bit_depth) - 1;
    const auto scaled = [&](std::uint16_t value) { return static_cast<std::uint16_t>(value * 65535LL / maximum); };
    std::vector<std::uint16_t> wanted{scaled(key.gray)};
    if (picture.channels == 3) wanted = {scaled(key.red), scaled(key.green), scaled(key.blue)};
    for (std::size_t k = 0; k < picture.values.size(); k += wanted.size()) {
      if (!std::equal(wanted.begin(), wanted.end(), picture.values.begin() + static_cast<std::ptrdiff_t>(k))) continue;
      refuse_transparency();
    }
  }

  Context context_;
  std::span<const std::uint8_t> bytes_;
  const std::string& name_;
  spng_ihdr header_{};
};

// 0, or libspng's error code.
int encode(std::FILE* file, const spng_ihdr& header, std::span<const std::uint8_t> rows) {
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  if (!context) return SPNG_EMEM;
  // Fast settings, because overlays and frames are viewed, not archived: one filter instead of the best of five a row
  // takes half the time for files of the same size.
  constexpr int kQuick = 1;
  spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, kQuick);
  spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
  spng_ihdr copy = header;
  int code = spng_set_ihdr(context.get(), &copy);
  if (code == 0) code = spng_set_png_file(context.get(), file);
  if (code == 0) {
    code = spng_encode_image(context.get(), rows.data(), rows.size(), SPNG_FMT_RAW, SPNG_ENCODE_FINALIZE);
  }
  return code;
}

}  // namespace

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), bytes.begin());
}

Picture decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  return PngReader(bytes, name).read();
}

void write_png(const std::string& path, std::int32_t width_px, std::int32_t height_px, PngPixels pixels,
               std::span<const std::uint8_t> rows) {
  std::optional<AtomicFile> place;
  std::FILE* file = path == "-" ? stdout : place.emplace(path).stream();
  const auto refuse = [&](const std::string& why) {
    throw InputError((path == "-" ? "standard output" : path) + ": cannot be written: " + why);
  };
  const bool wide = pixels == PngPixels::kGrey16 || pixels == PngPixels::kRgb16;
  const bool colour = pixels == PngPixels::kRgb8 || pixels == PngPixels::kRgb16;
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width_px);
  header.height = static_cast<std::uint32_t>(height_px);
  header.bit_depth = wide ? 16 : 8;
  header.color_type = colour ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;
  errno = 0;
  const int code = encode(file, header, rows);
  const int reason = errno;
  if (code != 0) refuse(code == SPNG_IO_ERROR && reason != 0 ? std::strerror(reason) : spng_strerror(code));
  if (place) return place->commit();
  if (std::fflush(file) != 0) refuse(std::strerror(errno));
}

}  // namespace pharos::host
