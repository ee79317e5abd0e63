// SPDX-License-Identifier: Apache-2.0
#include "host/images/grey_image.hpp"

#include "host/images/png_format.hpp"

namespace pharos::host {
namespace {

GreyImage grey(Picture&& picture) {
  GreyImage image{picture.width_px, picture.height_px, picture.bits, {}, false};
  if (picture.channels == 1) {
    image.pixels = std::move(picture.values);
    return image;
  }
  image.pixels.resize(picture.pixels());
  const std::uint16_t* rgb = picture.values.data();
  for (std::uint16_t& value : image.pixels) {
    const std::uint32_t red = rgb[0], green = rgb[1], blue = rgb[2];
    rgb += 3;
    if (red != green || green != blue) image.from_colour = true;
    value = static_cast<std::uint16_t>((299 * red + 587 * green + 114 * blue + 500) / 1000);
  }
  return image;
}

}  // namespace

GreyImage decode_grey_image(std::span<const std::uint8_t> bytes, const std::string& name) {
  return grey(decode_picture(bytes, name));
}

GreyImage read_grey_image(const std::string& path) { return grey(read_picture(path)); }

std::string colour_remark(const std::string& file) {
  return (file == "-" ? "standard input" : file) +
         ": is in colour; its luma (ITU-R BT.601) is taken, also of images that follow";
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
