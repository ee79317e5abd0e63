// SPDX-License-Identifier: Apache-2.0
#include "host/images/grey_image.hpp"

#include "host/images/png_format.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

GreyImage grey(Picture&& picture, const std::string& name) {
  if (picture.channels != 1) {
    throw InputError(name +
                     ": is in colour; a plain grey image is needed (convert IN -alpha off -colorspace Gray OUT)");
  }
  return {picture.width_px, picture.height_px, picture.bits, std::move(picture.values)};
}

}  // namespace

GreyImage decode_grey_image(std::span<const std::uint8_t> bytes, const std::string& name) {
  return grey(decode_picture(bytes, name), name);
}

GreyImage read_grey_image(const std::string& path) {
  return grey(read_picture(path), path == "-" ? "standard input" : path);
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
