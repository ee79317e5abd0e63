// SPDX-License-Identifier: Apache-2.0
#include "tools/flash/boot_image_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

/// More than the size of any flash of these boards: a longer file is not an image.
constexpr std::size_t kLongestFile = 64 << 20;

[[noreturn]] void refuse(const std::string& path, const std::string& text) {
  throw host::InputError(path + ": " + text);
}

std::vector<std::uint8_t> read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  std::vector<std::uint8_t> bytes;
  std::uint8_t part[65536];
  for (std::size_t got = 0; (got = std::fread(part, 1, sizeof part, file.get())) > 0;) {
    bytes.insert(bytes.end(), part, part + got);
    if (bytes.size() > kLongestFile) refuse(path, "is no image: far too long");
  }
  if (std::ferror(file.get()) != 0) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  return bytes;
}

const char* what_is_wrong(boot_image::BootImageError fault) {
  switch (fault) {
    case boot_image::BootImageError::kCutShort:
      return "is cut short; copy or build it again";
    case boot_image::BootImageError::kNoImage:
      return "is no image; take the file that ends in .image";
    case boot_image::BootImageError::kOtherFormat:
      return "is an image of another format; use the pharos that came with it";
    case boot_image::BootImageError::kTooLong:
      return "has bytes behind the image; copy or build it again";
    default:
      return "is damaged (CRC); copy or build it again";
  }
}

}  // namespace

BootImageFile read_image(const std::string& path) {
  BootImageFile file;
  file.bytes = read_file(path);
  const auto header = boot_image::check_image(file.bytes);
  if (!header) refuse(path, what_is_wrong(header.error()));
  file.header = *header;
  return file;
}

std::string to_text(const boot_image::Version& version) {
  return std::to_string(version.major) + '.' + std::to_string(version.minor) + '.' + std::to_string(version.patch);
}

}  // namespace pharos::tools
