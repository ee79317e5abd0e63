// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture.hpp"

namespace pharos::host {

/// Whether the bytes begin with the signature of a PNG.
bool is_png(std::span<const std::uint8_t> bytes);

/// See decode_picture.
Picture decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

/// Format of a PNG's rows.
enum class PngPixels { kGrey8, kGrey16, kRgb8, kRgb16 };

/// Writes rows of bytes (16 bits: high byte first) unchanged; `-` is standard output. Throws InputError where the
/// file cannot be written.
void write_png(const std::string& path, std::int32_t width_px, std::int32_t height_px, PngPixels pixels,
               std::span<const std::uint8_t> rows);

}  // namespace pharos::host
