// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pharos::tools {

/// Output of a measuring program: `name value` a line.
using TargetFigures = std::map<std::string, std::int64_t>;

/// The folder of the firmware's images: `given`, or the build tree's or the installed one beside the program. Throws
/// host::InputError when there is none, with what to do.
std::filesystem::path find_images(const std::string& given);

/// Runs IMAGES/NAME.elf under qemu-system-riscv32 with repeatable instruction counts, `input` in its memory. Throws
/// host::InputError when QEMU or the image is missing, or the program fails.
TargetFigures run_image(const std::filesystem::path& images, const std::string& name, const std::vector<char>& input);

/// Output of IMAGES/NAME.elf, a production build, on its serial line, for `words` of the emulated capture block, to
/// their end; repeatable as run_image. Throws as that.
std::string run_image_live(const std::filesystem::path& images, const std::string& name,
                           const std::vector<char>& words);

/// Bytes of an image by section.
struct ImageSizes {
  std::uint64_t code_and_constants = 0;
  std::uint64_t data = 0;  // initialised and zero
  std::uint64_t stack = 0;
};

/// Section sizes of IMAGES/NAME.elf; empty where there is no such 32-bit ELF file.
std::optional<ImageSizes> image_sizes(const std::filesystem::path& images, const std::string& name);

}  // namespace pharos::tools
