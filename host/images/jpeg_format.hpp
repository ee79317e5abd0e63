// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a JPEG.
bool is_jpeg(std::span<const std::uint8_t> bytes);

/// See decode_picture. Grey or colour of 8 bits; files for print (CMYK) are refused.
Picture decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name);

/// A JPEG of red, green, blue of 8 bits, row by row without gaps; quality 1 to 100. Colours are not subsampled, so that
/// thin coloured lines stay. Empty where the library has no memory.
std::vector<std::uint8_t> encode_jpeg(std::int32_t width_px, std::int32_t height_px, std::span<const std::uint8_t> rgb,
                                      int quality);

}  // namespace pharos::host
