// SPDX-License-Identifier: Apache-2.0
#include "host/images/image_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace pharos::host {

bool has_image_ending(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 9> kEndings = {".png", ".tif", ".tiff", ".pgm", ".ppm",
                                                        ".pnm", ".jpg", ".jpeg", ".bmp"};
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace pharos::host
