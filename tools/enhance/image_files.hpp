// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pharos::tools {

struct ImageFile {
  std::string path;
  std::string png_name;  ///< its own name, ending in .png
};

/// The images of a folder (by their names, see host::has_image_ending), sorted. Throws InputError for a folder that
/// cannot be read, without images, or with two that would have the same name as PNG.
std::vector<ImageFile> image_files(const std::string& folder);

/// Throws InputError where the folder does not exist and cannot be created.
void make_folder(const std::string& folder);

}  // namespace pharos::tools
