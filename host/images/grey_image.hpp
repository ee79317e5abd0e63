// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/picture.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::host {

/// A grey image in memory, row by row without gaps. Files of 8 bits come as 16 (value * 257: white is 65535 either
/// way).
struct GreyImage {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  int bits = 16;  ///< of the file's values: 8 or 16
  std::vector<std::uint16_t> pixels;

  ImageView<const std::uint16_t> view() const { return {pixels.data(), width_px, height_px}; }
  ImageView<std::uint16_t> view() { return {pixels.data(), width_px, height_px}; }
};

/// Reads a grey PNG, JPEG or binary PGM, told by content; `-` is standard input. Throws InputError for what is missing,
/// no such image, in colour, too large, damaged, or has less or more data than its header says.
GreyImage read_grey_image(const std::string& path);

/// The same from a file's bytes; `name` is for messages.
GreyImage decode_grey_image(std::span<const std::uint8_t> bytes, const std::string& name);

/// Writes a PNG of `bits` (8 or 16) a value, `-` being standard output; of 8 the upper half of each value is kept.
/// Throws InputError where it cannot be written.
void write_grey_png(const std::string& path, ImageView<const std::uint16_t> image, int bits = 16);

}  // namespace pharos::host
