// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image file: a whole image, or a complaint.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "host/images/picture.hpp"
#include "host/support/input_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::host;
  try {
    const Picture picture = decode_picture(std::span<const std::uint8_t>(data, size), "input");
    const bool channels = picture.channels == 1 || picture.channels == 3;
    const bool bits = picture.bits == 8 || picture.bits == 16;
    const bool whole = picture.width_px > 0 && picture.height_px > 0 && channels && bits &&
                       picture.values.size() == picture.pixels() * static_cast<std::size_t>(picture.channels) &&
                       picture.pixels() <= kMaxImagePixels;
    if (!whole) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
