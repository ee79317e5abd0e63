// SPDX-License-Identifier: Apache-2.0
#include "tools/enhance/image_files.hpp"

#include <algorithm>
#include <filesystem>

#include "host/images/image_names.hpp"
#include "host/support/input_error.hpp"

namespace pharos::tools {

namespace fs = std::filesystem;

std::vector<ImageFile> image_files(const std::string& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw host::InputError(folder + ": cannot be read: " + error.message());
  std::vector<ImageFile> files;
  for (const fs::directory_entry& entry : entries) {
    if (!host::has_image_ending(entry.path())) continue;
    files.push_back({entry.path().string(), entry.path().stem().string() + ".png"});
  }
  if (files.empty()) throw host::InputError(folder + ": holds no " + host::kImageEndings + " image");
  std::sort(files.begin(), files.end(), [](const ImageFile& a, const ImageFile& b) { return a.path < b.path; });
  for (std::size_t k = 1; k < files.size(); ++k) {
    if (files[k].png_name == files[k - 1].png_name) {
      throw host::InputError(files[k - 1].path + " and " + files[k].path + " would both become " + files[k].png_name +
                             "; rename one");
    }
  }
  return files;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw host::InputError(folder + ": cannot be made: " + (error ? error.message() : "it is a file"));
  }
}

}  // namespace pharos::tools
