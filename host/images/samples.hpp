// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/picture.hpp"

namespace pharos::host {

/// 8-bit values as 16 (value * 257).
std::vector<std::uint16_t> widened(std::span<const std::uint8_t> bytes);

/// Drops the last of the `channels` + 1 values a pixel, its opacity. Throws InputError where a pixel is not opaque
/// (65535): the background is unknown.
void drop_opacity(Picture& picture, const std::string& name);

/// A colour table's entry, 8 bits a colour.
struct PaletteEntry {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Converts a picture of 8 bits whose only channel holds indices into `palette`. It becomes grey where every entry is
/// grey, else colour. Throws InputError for an index without an entry; `kind` as in refuse_damaged.
void apply_palette(Picture& picture, std::span<const std::uint8_t> indices, std::span<const PaletteEntry> palette,
                   const std::string& name, const char* kind);

}  // namespace pharos::host
