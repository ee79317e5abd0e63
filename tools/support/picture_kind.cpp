// SPDX-License-Identifier: Apache-2.0
#include "tools/support/picture_kind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace pharos::tools {

CLI::Validator picture_kind(const std::string& suffix) {
  const auto refuse = [suffix](const std::string& path) {
    constexpr std::array kKinds = {".svg", ".png",  ".jpg", ".jpeg", ".bmp", ".gif", ".webp",
                                   ".tif", ".tiff", ".pgm", ".ppm",  ".eps", ".ps",  ".pdf"};
    std::string end = std::filesystem::path(path).extension().string();
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool other = end != suffix && std::find(kKinds.begin(), kKinds.end(), end) != kKinds.end();
    return other ? path + ": pictures are written as " + suffix + " only; name it so" : std::string();
  };
  return {refuse, "", "picture kind"};
}

}  // namespace pharos::tools
