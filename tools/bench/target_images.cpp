// SPDX-License-Identifier: Apache-2.0
#include "tools/bench/target_images.hpp"

#include <elf.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEmulator = "qemu-system-riscv32";
constexpr int kNoProgram = 127;

// A file that is gone when the run is over.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::vector<char>& bytes)
      : path_((fs::temp_directory_path() / "pharos-bench-XXXXXX").string()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw host::InputError(path_ + ": cannot make a temporary file");
    close(descriptor);
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// Replaces this (forked) process by the emulator, its output into `output`.
[[noreturn]] void become_emulator(const std::string& image, const std::string& input, int output) {
  dup2(output, STDOUT_FILENO);
  const std::string program = "loader,cpu-num=0,file=" + image;
  const std::string data = "loader,addr=0x82000000,force-raw=on,file=" + input;
  execlp(kEmulator, kEmulator, "-M", "virt", "-smp", "1", "-m", "128M", "-bios", "none", "-nodefaults", "-display",
         "none", "-serial", "stdio", "-icount", "shift=0,sleep=off", "-device", program.c_str(), "-device",
         data.c_str(), nullptr);
  _exit(kNoProgram);
}

std::string output_of(const std::string& image, const std::string& input) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw host::InputError("cannot make a pipe to the emulator");
  const pid_t child = fork();
  if (child < 0) throw host::InputError("cannot start the emulator");
  if (child == 0) become_emulator(image, input, ends[1]);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> block{};
  for (ssize_t n = 0; (n = read(ends[0], block.data(), block.size())) > 0;) {
    text.append(block.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram) {
    throw host::InputError(std::string(kEmulator) +
                           " is not installed; Debian's package is qemu-system-misc (tools/install-dependencies test)");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw host::InputError(image + ": the program failed under the emulator" + (text.empty() ? "" : ": " + text));
  }
  return text;
}

template <class Header>
const Header* at(const std::string& bytes, std::uint64_t offset) {
  return offset + sizeof(Header) <= bytes.size() ? reinterpret_cast<const Header*>(bytes.data() + offset) : nullptr;
}

void add_section(const std::string& name, const Elf32_Shdr& section, ImageSizes& sizes) {
  if ((section.sh_flags & SHF_ALLOC) == 0 || name == ".device") return;
  if (name == ".stack") {
    sizes.stack += section.sh_size;
  } else if ((section.sh_flags & SHF_WRITE) != 0) {
    sizes.data += section.sh_size;
  } else {
    sizes.code_and_constants += section.sh_size;
  }
}

}  // namespace

fs::path find_images(const std::string& given) {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> places{given};
  if (given.empty()) places = {beside / "../firmware/bin", beside / "../share/pharos/firmware"};
  for (const fs::path& place : places) {
    if (fs::exists(place / "measure_pose.elf", error)) return fs::weakly_canonical(place, error);
  }
  throw host::InputError(places.front().string() +
                         ": holds no measure_pose.elf; build the target `firmware`, or name the folder with --images");
}

Findings run_image(const fs::path& images, const std::string& name, const std::vector<char>& input) {
  const fs::path image = images / (name + ".elf");
  std::error_code error;
  if (!fs::exists(image, error))
    throw host::InputError(image.string() + ": no such image; build the target `firmware`");
  const TemporaryFile file(input);
  std::istringstream lines(output_of(image.string(), file.path()));
  Findings findings;
  std::string what;
  for (std::int64_t value = 0; lines >> what >> value;) findings[what] = value;
  if (findings.empty()) throw host::InputError(image.string() + ": said nothing that can be read");
  return findings;
}

std::optional<ImageSizes> image_sizes(const fs::path& images, const std::string& name) {
  std::ifstream file(images / (name + ".elf"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto* header = at<Elf32_Ehdr>(bytes, 0);
  if (header == nullptr || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0 ||
      header->e_ident[EI_CLASS] != ELFCLASS32) {
    return std::nullopt;
  }
  const auto* names = at<Elf32_Shdr>(bytes, header->e_shoff + std::uint64_t{header->e_shstrndx} * sizeof(Elf32_Shdr));
  ImageSizes sizes;
  for (std::uint64_t k = 0; names != nullptr && k < header->e_shnum; ++k) {
    const auto* section = at<Elf32_Shdr>(bytes, header->e_shoff + k * sizeof(Elf32_Shdr));
    if (section == nullptr) return std::nullopt;
    const std::uint64_t begin = std::uint64_t{names->sh_offset} + section->sh_name;
    const std::size_t end = begin < bytes.size() ? bytes.find('\0', begin) : std::string::npos;
    if (end == std::string::npos) return std::nullopt;
    add_section(bytes.substr(begin, end - begin), *section, sizes);
  }
  return sizes;
}

}  // namespace pharos::tools
