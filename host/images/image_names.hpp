// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace pharos::host {

/// Whether the file's name has the extension of an image that read_picture reads: .png .tif .tiff .pgm .ppm .pnm .jpg
/// .jpeg .bmp, in small or capital letters. For listing folders; the format is determined by the content.
bool has_image_ending(const std::filesystem::path& file);

/// For messages about folders without images.
inline constexpr const char* kImageEndings = ".png, .tif, .pgm, .ppm, .jpg or .bmp";

}  // namespace pharos::host
