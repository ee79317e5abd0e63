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

/// A grey image in memory, row by row without gaps. Values of 8-bit files are converted to 16 bits (value * 257: white
/// is 65535 in both cases).
struct GreyImage {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  int bits = 16;  ///< of the file's values: 8 or 16
  std::vector<std::uint16_t> pixels;
  bool from_colour = false;  ///< pixels are the luma of colours

  ImageView<const std::uint16_t> view() const { return {pixels.data(), width_px, height_px}; }
  ImageView<std::uint16_t> view() { return {pixels.data(), width_px, height_px}; }
};

/// Reads an image as read_picture does; of colour the luma, 0.299 R + 0.587 G + 0.114 B (ITU-R BT.601, of the values as
/// they are stored). Throws InputError as read_picture does.
GreyImage read_grey_image(const std::string& path);

/// The same from a file's bytes; `name` is for messages.
GreyImage decode_grey_image(std::span<const std::uint8_t> bytes, const std::string& name);

/// The message that a program prints once, for the first colour image converted to luma.
std::string colour_remark(const std::string& file);

/// Writes a PNG of `bits` (8 or 16) a value, `-` being standard output; of 8 the upper half of each value is kept.
/// Throws InputError where it cannot be written.
void write_grey_png(const std::string& path, ImageView<const std::uint16_t> image, int bits = 16);

}  // namespace pharos::host
