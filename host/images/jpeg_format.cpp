// SPDX-License-Identifier: Apache-2.0
// libjpeg reports errors by a function that must not return: the functions that call it hold no objects to be destroyed
// and say what went wrong through a plain structure; only their callers throw.
#include "host/images/jpeg_format.hpp"

#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it before

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// A progressive file of a few bytes a scan would keep the decoder busy for minutes; cameras make ten scans.
constexpr int kMaxScans = 100;
// A block of 8 x 8 takes one bit at least.
constexpr std::size_t kMaxPixelsPerByte = 8 * 64;

struct Trouble {
  jpeg_error_mgr manager{};  // first: libjpeg hands out its address
  std::jmp_buf way_out{};
  std::array<char, JMSG_LENGTH_MAX> text{};
  bool damaged = false;
};

Trouble& error_of(j_common_ptr jpeg) { return *reinterpret_cast<Trouble*>(jpeg->err); }

[[noreturn]] void on_error(j_common_ptr jpeg) {
  Trouble& error = error_of(jpeg);
  jpeg->err->format_message(jpeg, error.text.data());
  error.damaged = true;
  std::longjmp(error.way_out, 1);
}

// libjpeg makes up what is missing and warns (level -1); here that is a damaged file.
void on_message(j_common_ptr jpeg, int level) {
  if (level >= 0 || error_of(jpeg).damaged) return;
  jpeg->err->format_message(jpeg, error_of(jpeg).text.data());
  error_of(jpeg).damaged = true;
}

struct Reader {
  explicit Reader(std::span<const std::uint8_t> all) : bytes(all) {
    jpeg.err = jpeg_std_error(&error.manager);
    error.manager.error_exit = on_error;
    error.manager.emit_message = on_message;
    error.manager.output_message = [](j_common_ptr) {};
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { jpeg_destroy_decompress(&jpeg); }

  std::span<const std::uint8_t> bytes;
  Trouble error;
  jpeg_progress_mgr progress{};
  jpeg_decompress_struct jpeg{};
};

bool read_header(Reader& reader) {
  if (setjmp(reader.error.way_out) != 0) return false;
  jpeg_create_decompress(&reader.jpeg);
  reader.progress.progress_monitor = [](j_common_ptr jpeg) {
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMaxScans) return;
    std::snprintf(error_of(jpeg).text.data(), error_of(jpeg).text.size(), "more than %d scans", kMaxScans);
    error_of(jpeg).damaged = true;
    std::longjmp(error_of(jpeg).way_out, 1);
  };
  reader.jpeg.progress = &reader.progress;
  jpeg_mem_src(&reader.jpeg, reader.bytes.data(), reader.bytes.size());
  jpeg_read_header(&reader.jpeg, TRUE);
  return true;
}

bool read_rows(Reader& reader, std::uint8_t* rows, std::size_t stride) {
  if (setjmp(reader.error.way_out) != 0) return false;
  jpeg_start_decompress(&reader.jpeg);
  while (reader.jpeg.output_scanline < reader.jpeg.output_height) {
    JSAMPROW row = rows + reader.jpeg.output_scanline * stride;
    jpeg_read_scanlines(&reader.jpeg, &row, 1);
    if (reader.error.damaged) return false;
  }
  jpeg_finish_decompress(&reader.jpeg);
  return !reader.error.damaged;
}

[[noreturn]] void damaged(const std::string& name, const Trouble& error) {
  throw InputError(name + ": damaged JPEG (" + error.text.data() + "); save or copy it again");
}

}  // namespace

bool is_jpeg(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

Picture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
  Reader reader(bytes);
  if (!read_header(reader)) damaged(name, reader.error);
  const jpeg_decompress_struct& jpeg = reader.jpeg;
  require_readable_size(jpeg.image_width, jpeg.image_height, name);
  Picture picture{static_cast<std::int32_t>(jpeg.image_width),
                  static_cast<std::int32_t>(jpeg.image_height),
                  jpeg.num_components == 1 ? 1 : 3,
                  8,
                  {}};
  if (jpeg.num_components != 1 && jpeg.num_components != 3) {
    throw InputError(name + ": has " + std::to_string(jpeg.num_components) +
                     " colours; grey or red, green and blue are needed (convert IN -colorspace sRGB OUT)");
  }
  if (picture.pixels() > kMaxPixelsPerByte * bytes.size()) {
    throw InputError(name + ": damaged JPEG (less data than its header says); save or copy it again");
  }
  reader.jpeg.out_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  const std::size_t stride = static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.channels);
  std::vector<std::uint8_t> rows(stride * static_cast<std::size_t>(picture.height_px));
  if (!read_rows(reader, rows.data(), stride)) damaged(name, reader.error);
  picture.values.reserve(rows.size());
  for (const std::uint8_t value : rows) picture.values.push_back(static_cast<std::uint16_t>(value * 257));
  return picture;
}

}  // namespace pharos::host
