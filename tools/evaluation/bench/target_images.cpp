// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/target_images.hpp"

#include <elf.h>
#include <fcntl.h>
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

// A file that is removed at the end of the run.
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

constexpr std::array kMachine = {kEmulator, "-M",   "virt",        "-smp",     "1",    "-m",      "128M",
                                 "-bios",   "none", "-nodefaults", "-display", "none", "-icount", "shift=0,sleep=off"};

// Replaces this (forked) process by the emulator with an image and further options.
[[noreturn]] void become_emulator(const std::string& image, const std::vector<std::string>& options) {
  const std::string program = "loader,cpu-num=0,file=" + image;
  std::vector<const char*> arguments(kMachine.begin(), kMachine.end());
  arguments.insert(arguments.end(), {"-device", program.c_str()});
  for (const std::string& option : options) arguments.push_back(option.c_str());
  arguments.push_back(nullptr);
  execvp(kEmulator, const_cast<char* const*>(arguments.data()));
  _exit(kNoProgram);
}

// Returns its standard output; `input` is its standard input where given.
std::string output_of(const std::string& image, const std::vector<std::string>& options,
                      const std::string& input = "") {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw host::InputError("cannot make a pipe to the emulator");
  const pid_t child = fork();
  if (child < 0) throw host::InputError("cannot start the emulator");
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    if (!input.empty()) dup2(open(input.c_str(), O_RDONLY), STDIN_FILENO);
    become_emulator(image, options);
  }
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

// The image's path. Throws where it does not exist.
std::string image_of(const fs::path& images, const std::string& name) {
  const fs::path image = images / (name + ".elf");
  std::error_code error;
  if (fs::exists(image, error)) return image.string();
  throw host::InputError(image.string() + ": no such image; build the target `firmware`");
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
  throw host::InputError(
      places.front().string() +
      ": holds no measure_pose.elf. Build the images (cmake --build build --target firmware) and, where "
      "this program is installed, install again; or name their folder with --images");
}

TargetFigures run_image(const fs::path& images, const std::string& name, const std::vector<char>& input) {
  const std::string image = image_of(images, name);
  const TemporaryFile file(input);
  std::istringstream lines(
      output_of(image, {"-serial", "stdio", "-device", "loader,addr=0x82000000,force-raw=on,file=" + file.path()}));
  TargetFigures figures;
  std::string what;
  for (std::int64_t value = 0; lines >> what >> value;) figures[what] = value;
  if (figures.empty()) throw host::InputError(image + ": said nothing that can be read");
  return figures;
}

std::string run_image_live(const fs::path& images, const std::string& name, const std::vector<char>& words) {
  const std::string image = image_of(images, name);
  const TemporaryFile tape(words);
  const TemporaryFile line({});
  output_of(image,
            {"-serial", "file:" + line.path(), "-chardev", "stdio,id=edges,signal=off", "-device",
             "virtio-serial-device", "-device", "virtconsole,chardev=edges"},
            tape.path());
  std::ifstream printed(line.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(printed), std::istreambuf_iterator<char>()};
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
