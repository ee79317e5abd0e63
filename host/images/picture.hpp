// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/limits.hpp"

namespace pharos::host {

/// A grey or colour image in memory, row by row without gaps, pixel by pixel one value or three (red, green, blue).
/// Values of 8-bit files are converted to 16 bits (value * 257: white is 65535 in both cases).
struct Picture {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  int channels = 1;  ///< 1 or 3
  int bits = 16;     ///< of the file's values: 8 or 16
  std::vector<std::uint16_t> values;

  std::size_t pixels() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
};

/// Reads an image; the content determines the format, not the name; `-` is standard input: PNG, TIFF and binary PGM and
/// PPM of 8 or 16 bits, JPEG and BMP of 8. Rows are in the order of the file: an orientation tag (EXIF) is ignored,
/// because a camera file describes the sensor's rows. Opacity is dropped where all pixels are opaque. Throws InputError
/// for an image that is missing, of another format, transparent, larger than the limits, damaged, or has less data than
/// its header declares.
Picture read_picture(const std::string& path);

/// The same from a file's bytes; `name` is for messages.
Picture decode_picture(std::span<const std::uint8_t> bytes, const std::string& name);

/// Writes a PNG of the picture's bits (8 keeps the upper half of each value); `-` is standard output. Throws InputError
/// where it cannot be written.
void write_picture(const std::string& path, const Picture& picture);

}  // namespace pharos::host
