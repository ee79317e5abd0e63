// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image file of any format: a complete image, or an error of one line.
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "host/images/grey_image.hpp"
#include "host/images/picture.hpp"
#include "host/support/input_error.hpp"

namespace {

using namespace pharos::host;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const Picture& picture, const GreyImage& grey) {
  require(picture.width_px > 0 && picture.height_px > 0);
  require(picture.width_px <= kMaxImageSide_px && picture.height_px <= kMaxImageSide_px);
  require(picture.pixels() <= kMaxImagePixels);
  require(picture.channels == 1 || picture.channels == 3);
  require(picture.bits == 8 || picture.bits == 16);
  require(picture.values.size() == picture.pixels() * static_cast<std::size_t>(picture.channels));
  require(grey.width_px == picture.width_px && grey.height_px == picture.height_px && grey.bits == picture.bits);
  require(grey.pixels.size() == picture.pixels());
  if (picture.channels == 1) require(!grey.from_colour && grey.pixels == picture.values);
  for (const std::uint16_t value : picture.values) require(picture.bits == 16 || value % 257 == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  try {
    check(decode_picture(bytes, "input"), decode_grey_image(bytes, "input"));
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    require(text.starts_with("input: ") && text.find('\n') == std::string_view::npos);
  }
  return 0;
}
