// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image file: a whole image, or a complaint.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::host;
  try {
    const GreyImage image = decode_grey_image(std::span<const std::uint8_t>(data, size), "input");
    const bool whole = image.width_px > 0 && image.height_px > 0 && image.pixels.size() == image.view().pixels() &&
                       (image.bits == 8 || image.bits == 16) && image.pixels.size() <= kMaxImagePixels;
    if (!whole) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
