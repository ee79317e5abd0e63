// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pharos::host {

/// Largest side and most pixels of an image that is read or written: what 16-bit columns can name, and 64 MiB of grey.
/// A few bytes of PNG can claim gigabytes.
inline constexpr std::int32_t kMaxImageSide_px = 32767;
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 25;

/// A grey or colour image in memory, row by row without gaps, pixel by pixel one value or three (red, green, blue).
/// Files of 8 bits come as 16 (value * 257: white is 65535 either way).
struct Picture {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  int channels = 1;  ///< 1 or 3
  int bits = 16;     ///< of the file's values: 8 or 16
  std::vector<std::uint16_t> values;

  std::size_t pixels() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
};

/// Reads a PNG, JPEG or binary PGM or PPM, told by content; `-` is standard input. Throws InputError for what is
/// missing, no such image, transparent, too large, damaged, or has less or more data than its header says.
Picture read_picture(const std::string& path);

/// The same from a file's bytes; `name` is for messages.
Picture decode_picture(std::span<const std::uint8_t> bytes, const std::string& name);

/// Writes a PNG of the picture's bits (8 keeps the upper half of each value); `-` is standard output. Throws InputError
/// where it cannot be written.
void write_picture(const std::string& path, const Picture& picture);

/// Throws InputError, in the name of the file, for sides and pixels beyond the limits above.
void require_readable_size(std::size_t width_px, std::size_t height_px, const std::string& name);

}  // namespace pharos::host
