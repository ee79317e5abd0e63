// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a BMP.
bool is_bmp(std::span<const std::uint8_t> bytes);

/// See decode_picture. Uncompressed, of 8 bits (palette), 24 or 32, rows upwards or downwards; headers of OS/2 1.x and
/// of Windows 3 to 5 (BITMAPINFOHEADER, V2 to V5). Others are refused.
Picture decode_bmp(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::host
