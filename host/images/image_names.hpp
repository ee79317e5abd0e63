// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace pharos::host {

/// Whether the file's name ends as an image's does that read_picture takes: .png .tif .tiff .pgm .ppm .pnm .jpg .jpeg
/// .bmp, in small or capital letters. For looking through folders; what a file is, its content tells.
bool has_image_ending(const std::filesystem::path& file);

/// For messages about folders without any.
inline constexpr const char* kImageEndings = ".png, .tif, .pgm, .ppm, .jpg or .bmp";

}  // namespace pharos::host
