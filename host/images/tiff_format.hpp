// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a TIFF or BigTIFF.
bool is_tiff(std::span<const std::uint8_t> bytes);

/// See decode_picture. The first image of the file: grey (black or white is zero), palette or red, green and blue;
/// unsigned values of 8 or 16 bits, in strips or tiles, colours interleaved or planar; uncompressed, PackBits, LZW,
/// Deflate or JPEG.
Picture decode_tiff(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::host
