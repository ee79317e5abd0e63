// SPDX-License-Identifier: Apache-2.0
// libpng reports errors by longjmp: the functions that call it hold no objects to be destroyed, and say what went wrong
// through a plain structure; only their callers throw.
#include "host/images/png_format.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kSignature = 8;

struct Trouble {
  std::array<char, 128> text{};
  bool too_much_data = false;

  void say(const char* message) { std::snprintf(text.data(), text.size(), "%s", message); }
};

Trouble& error_of(png_structp png) { return *static_cast<Trouble*>(png_get_error_ptr(png)); }

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  error_of(png).say(message);
  png_longjmp(png, 1);
}

// Most warnings are about colour profiles and do no harm; an image of more data than its header says is another matter.
void on_warning(png_structp png, png_const_charp message) {
  const std::string_view text = message;
  if (text.find("Extra compressed data") != std::string_view::npos ||
      text.find("Too much image data") != std::string_view::npos) {
    error_of(png).too_much_data = true;
  }
}

struct Bytes {
  const std::uint8_t* next;
  std::size_t left;
};

void take(png_structp png, png_bytep out, std::size_t count) {
  Bytes& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  if (count > bytes.left) png_error(png, "the file ends too soon");
  std::memcpy(out, bytes.next, count);
  bytes.next += count;
  bytes.left -= count;
}

struct Header {
  png_uint_32 width = 0, height = 0;
  int bits = 0, colour = 0;
};

// A reader whose ends are freed however it is left.
struct Reader {
  explicit Reader(std::span<const std::uint8_t> all) : bytes{all.data(), all.size()} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, on_error, on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) return;
    png_set_read_fn(png, &bytes, take);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours are checked after, and named in the message
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  Bytes bytes;
  Trouble error;
  png_structp png = nullptr;
  png_infop info = nullptr;
};

bool read_header(Reader& reader, Header& header) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_info(reader.png, reader.info);
  png_get_IHDR(reader.png, reader.info, &header.width, &header.height, &header.bits, &header.colour, nullptr, nullptr,
               nullptr);
  return true;
}

bool read_rows(Reader& reader, png_bytep* rows, bool swap) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_expand_gray_1_2_4_to_8(reader.png);
  png_set_palette_to_rgb(reader.png);
  if (swap) png_set_swap(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

void check(const Header& header, bool transparent_colour, const std::string& name) {
  if ((header.colour & PNG_COLOR_MASK_ALPHA) != 0 || transparent_colour) {
    throw InputError(name + ": has transparency; an image without is needed (convert IN -alpha off OUT)");
  }
  require_readable_size(header.width, header.height, name);
}

[[noreturn]] void damaged(const std::string& name, const char* why) {
  throw InputError(name + ": damaged PNG (" + why + "); save or copy it again");
}

struct Writer {
  explicit Writer(Trouble& error) {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, on_error, nullptr);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }

  png_structp png = nullptr;
  png_infop info = nullptr;
};

bool write_all(Writer& writer, std::FILE* file, png_uint_32 width, png_uint_32 height, PngPixels pixels,
               png_const_bytep rows, std::size_t stride) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  constexpr int kQuick = 1;  // overlays and frames are looked at, not archived
  png_init_io(writer.png, file);
  png_set_compression_level(writer.png, kQuick);
  const bool wide = pixels == PngPixels::kGrey16 || pixels == PngPixels::kRgb16;
  const bool colour = pixels == PngPixels::kRgb8 || pixels == PngPixels::kRgb16;
  png_set_IHDR(writer.png, writer.info, width, height, wide ? 16 : 8, colour ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  for (png_uint_32 v = 0; v < height; ++v) png_write_row(writer.png, rows + v * stride);
  png_write_end(writer.png, writer.info);
  return true;
}

}  // namespace

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kSignature && png_sig_cmp(bytes.data(), 0, kSignature) == 0;
}

Picture decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  Reader reader(bytes);
  if (reader.info == nullptr) throw InputError(name + ": no memory to read it");
  Header header;
  if (!read_header(reader, header)) damaged(name, reader.error.text.data());
  check(header, png_get_valid(reader.png, reader.info, PNG_INFO_tRNS) != 0, name);
  const std::size_t pixels = static_cast<std::size_t>(header.width) * header.height;
  const bool palette = header.colour == PNG_COLOR_TYPE_PALETTE;
  const std::size_t file_channels = header.colour == PNG_COLOR_TYPE_RGB ? 3 : 1;
  // No row of deflated data shrinks to less than a thousandth: a claim beyond is told before memory is taken.
  constexpr std::size_t kMaxDeflation = 1100;
  if (pixels * file_channels * static_cast<std::size_t>(header.bits) / 8 > kMaxDeflation * bytes.size()) {
    damaged(name, "less data than its header says");
  }
  Picture picture;
  picture.width_px = static_cast<std::int32_t>(header.width);
  picture.height_px = static_cast<std::int32_t>(header.height);
  picture.channels = file_channels == 3 || palette ? 3 : 1;
  picture.bits = header.bits == 16 ? 16 : 8;
  const std::size_t channels = static_cast<std::size_t>(picture.channels);
  picture.values.resize(pixels * channels);
  const std::size_t value_bytes = header.bits == 16 ? 2 : 1;
  auto* all = reinterpret_cast<png_bytep>(picture.values.data());
  std::vector<png_bytep> rows(header.height);
  for (std::size_t v = 0; v < rows.size(); ++v) rows[v] = all + v * header.width * channels * value_bytes;
  if (!read_rows(reader, rows.data(), header.bits == 16)) damaged(name, reader.error.text.data());
  if (reader.error.too_much_data) damaged(name, "more data than its header says");
  if (value_bytes == 1) {  // widened in place, from the end
    for (std::size_t k = picture.values.size(); k-- > 0;) picture.values[k] = static_cast<std::uint16_t>(all[k] * 257);
  }
  return picture;
}

void write_png(const std::string& path, std::int32_t width_px, std::int32_t height_px, PngPixels pixels,
               std::span<const std::uint8_t> rows) {
  std::FILE* file = path == "-" ? stdout : std::fopen(path.c_str(), "wb");
  const auto refuse = [&](const std::string& why) {
    throw InputError((path == "-" ? "standard output" : path) + ": cannot be written: " + why);
  };
  if (file == nullptr) refuse(std::strerror(errno));
  Trouble error;
  bool written = false;
  {
    Writer writer(error);
    const std::size_t stride = rows.size() / static_cast<std::size_t>(std::max(1, height_px));
    written = writer.info != nullptr && write_all(writer, file, static_cast<png_uint_32>(width_px),
                                                  static_cast<png_uint_32>(height_px), pixels, rows.data(), stride);
  }
  const bool closed = (file == stdout ? std::fflush(file) : std::fclose(file)) == 0;
  if (!written) refuse(error.text.data());
  if (!closed) refuse(std::strerror(errno));
}

}  // namespace pharos::host
