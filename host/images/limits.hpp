// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pharos::host {

/// Largest side of an image that is read or written: the largest signed 16-bit index.
inline constexpr std::int32_t kMaxImageSide_px = 32767;
/// Most pixels of an image: 64 MiB of grey values. The header of a small PNG can declare gigabytes.
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 25;
/// Most bytes that decoding one image may fill (256 MiB): four values of 16 bits a pixel, the widest layout that is
/// read (red, green, blue, opacity).
inline constexpr std::size_t kMaxDecodedBytes = 8 * kMaxImagePixels;
/// Most bytes of a file: the decoded limit, and space for headers and comments.
inline constexpr std::size_t kMaxImageFileBytes = kMaxDecodedBytes + (std::size_t{1} << 20);

/// Throws InputError that names the file, for sides and pixels beyond the limits above.
void require_readable_size(std::size_t width_px, std::size_t height_px, const std::string& name);

/// Throws InputError: the file is damaged, with the reason and the remedy. `kind`: "PNG", "TIFF", ...
[[noreturn]] void refuse_damaged(const std::string& name, const char* kind, const std::string& why);

inline constexpr const char* kLessData = "less data than its header says";
inline constexpr const char* kMoreData = "more data than its header says";

}  // namespace pharos::host
