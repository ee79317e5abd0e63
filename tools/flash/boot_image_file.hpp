// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pharos/boot_image/boot_image_header.hpp"

namespace pharos::tools {

/// A complete image as `pharos flash` sends it.
struct BootImageFile {
  std::vector<std::uint8_t> bytes;
  boot_image::BootImageHeader header{};
};

/// Throws host::InputError with the reason: file missing, not an image, truncated, damaged.
BootImageFile read_image(const std::string& path);

/// "1.2.3"
std::string to_text(const boot_image::Version& version);
/// A header's text without its padding.
template <std::size_t N>
std::string_view view(const std::array<char, N>& text) {
  std::size_t size = 0;
  while (size < N && text[size] != '\0') ++size;
  return {text.data(), size};
}

}  // namespace pharos::tools
