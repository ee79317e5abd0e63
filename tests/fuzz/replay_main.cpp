// SPDX-License-Identifier: Apache-2.0
// Replaces libFuzzer's main: passes every file of the folders (or single files) named on the command line, in the
// order of their names, to the target named first. A folder without inputs is an error, so that a missing corpus is
// detected.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

// fuzz_targets.inc is written by CMake: one PHAROS_FUZZ_TARGET(NAME) a target.
#define PHAROS_FUZZ_TARGET(name) extern "C" int name##_one_input(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef PHAROS_FUZZ_TARGET

namespace {

using Target = int (*)(const std::uint8_t* data, std::size_t size);

Target target_named(std::string_view wanted) {
#define PHAROS_FUZZ_TARGET(name) \
  if (wanted == #name) return name##_one_input;
#include "fuzz_targets.inc"
#undef PHAROS_FUZZ_TARGET
  return nullptr;
}

std::vector<std::filesystem::path> inputs_under(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool replay(Target target, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
    return false;
  }
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::vector<std::uint8_t> input(bytes.begin(), bytes.end());
  target(input.data(), input.size());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const Target target = argc > 1 ? target_named(argv[1]) : nullptr;
  if (target == nullptr) {
    std::fprintf(stderr, "usage: fuzz_replay TARGET FOLDER...\n");
    return 2;
  }
  std::size_t replayed = 0;
  for (int argument = 2; argument < argc; ++argument) {
    for (const auto& file : inputs_under(argv[argument])) {
      if (!replay(target, file)) return 1;
      ++replayed;
    }
  }
  std::printf("%zu inputs replayed\n", replayed);
  return replayed > 0 ? 0 : 1;
}
