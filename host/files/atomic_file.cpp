// SPDX-License-Identifier: Apache-2.0
#include "host/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFile = 0666;  // what umask leaves of it
constexpr mode_t kModeBits = 0777;
constexpr int kAttempts = 100;  // 64 random bits collide once in 10^19

std::string random_name() {
  std::array<unsigned char, 8> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::system_error(errno, std::generic_category(), "getrandom");
  }
  std::string name = ".pharos-";
  for (const unsigned char byte : bytes) {
    name += "0123456789abcdef"[byte >> 4];
    name += "0123456789abcdef"[byte & 15];
  }
  return name;
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Nothing in /dev or /proc is ours to replace.
bool is_of_the_system(const fs::path& path) {
  std::error_code error;
  const std::string folder = fs::weakly_canonical(folder_of(path), error).string();
  return folder == "/dev" || folder.rfind("/dev/fd", 0) == 0 || folder == "/proc" || folder.rfind("/proc/", 0) == 0;
}

// A pipe or a device has no place to be put into. One look only: between two of them the path may become another file.
bool is_replaceable(const fs::path& path) {
  struct stat about {};
  return !is_of_the_system(path) && (::stat(path.c_str(), &about) != 0 || S_ISREG(about.st_mode));
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), base_(fs::path(path_).filename().string()) {
  if (base_.empty() || base_ == "." || base_ == "..") {
    errno = path_.empty() ? ENOENT : EISDIR;
    refuse();
  }
  if (is_replaceable(path_)) {
    open_aside();
  } else {
    open_in_place();
  }
}

AtomicFile::~AtomicFile() {
  if (stream_ != nullptr) std::fclose(stream_);
  if (!aside_.empty()) ::unlinkat(folder_.get(), aside_.c_str(), 0);
}

void AtomicFile::refuse() const {
  throw InputError(path_ + ": cannot be written: " + std::strerror(errno) + "; choose another file");
}

// What was a pipe or a device before may be a link to somebody's file now: such a file is neither created nor cut.
void AtomicFile::open_in_place() {
  const bool redirected = is_of_the_system(path_);  // /dev/stdout may lead to a file
  UniqueFd fd(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | (redirected ? O_CREAT | O_TRUNC : 0), kNewFile));
  struct stat about {};
  const bool has_changed = fd.valid() ? ::fstat(fd.get(), &about) != 0 || S_ISREG(about.st_mode) : errno == ENOENT;
  if (has_changed && !redirected) return open_aside();
  if (fd.valid()) stream_ = ::fdopen(fd.get(), "w");
  if (stream_ == nullptr) refuse();
  fd.release();
}

void AtomicFile::open_aside() {
  folder_.reset(::open(folder_of(path_).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder_.valid()) refuse();
  UniqueFd fd;
  for (int i = 0; !fd.valid() && (i == 0 || errno == EEXIST) && i < kAttempts; ++i) {
    aside_ = random_name();
    fd.reset(::openat(folder_.get(), aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFile));
  }
  if (!fd.valid()) aside_.clear();
  if (fd.valid()) stream_ = ::fdopen(fd.get(), "w");
  if (stream_ == nullptr) {
    const int reason = errno;
    if (!aside_.empty()) ::unlinkat(folder_.get(), aside_.c_str(), 0);
    errno = reason;
    refuse();
  }
  fd.release();
  take_over_mode();
}

// Of the file that is replaced; a link has no mode of its own.
void AtomicFile::take_over_mode() const {
  struct stat old {};
  if (::fstatat(folder_.get(), base_.c_str(), &old, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(old.st_mode)) return;
  const int fd = ::fileno(stream_);
  if (old.st_uid != ::geteuid() || old.st_gid != ::getegid()) {
    static_cast<void>(::fchown(fd, old.st_uid, old.st_gid) == 0);  // of somebody else's file: where this may do so
  }
  static_cast<void>(::fchmod(fd, old.st_mode & kModeBits) == 0);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) refuse();
}

void AtomicFile::flush(Sync sync) {
  if (std::fflush(stream_) != 0 || std::ferror(stream_) != 0) refuse();
  if (sync == Sync::kToDisk && ::fsync(::fileno(stream_)) != 0 && errno != EINVAL) refuse();
}

// Closed before it gets its name: whoever watches the folder sees one file arrive, complete.
void AtomicFile::commit(Sync sync) {
  flush(sync);
  if (std::fclose(std::exchange(stream_, nullptr)) != 0) refuse();
  if (!folder_.valid()) return;
  if (::renameat(folder_.get(), aside_.c_str(), folder_.get(), base_.c_str()) != 0) refuse();
  aside_.clear();  // nothing to remove any more
  if (sync == Sync::kNo) return;
  const UniqueFd folder(::openat(folder_.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  static_cast<void>(folder.valid() && ::fsync(folder.get()) == 0);
}

void write_file(const std::string& path, std::string_view bytes, AtomicFile::Sync sync) {
  if (path != "-") {
    AtomicFile file(path);
    file.write(bytes);
    return file.commit(sync);
  }
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
    throw InputError(std::string("standard output: cannot be written: ") + std::strerror(errno));
  }
}

void require_writable(const std::string& path) {
  if (path != "-" && is_replaceable(path)) const AtomicFile tried(path);
}

}  // namespace pharos::host
