// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A file that takes its place when it is complete: until commit() whoever opens the path sees the old file, and
/// without commit() nothing remains. See README.md for links, modes and devices.
class AtomicFile {
 public:
  enum class Sync : std::uint8_t {
    kNo,
    kToDisk,  // survives a power cut once commit() has returned; takes milliseconds to seconds
  };

  /// Throws InputError where the path cannot be written: no such folder, no permission, a directory.
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Buffered; belongs to this object. Null after commit().
  std::FILE* stream() { return stream_; }
  /// Throws InputError when the disk is full.
  void write(std::string_view bytes);
  /// Puts the file in its place. Throws InputError where it cannot be written or put there; the old file remains then.
  void commit(Sync sync = Sync::kNo);
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void refuse() const;
  void open_aside();
  void open_in_place();
  void take_over_mode() const;
  void flush(Sync sync);

  std::string path_;
  std::string base_;   // the last part of the path
  UniqueFd folder_;    // invalid: written in place
  std::string aside_;  // its name in the folder until commit()
  std::FILE* stream_ = nullptr;
};

/// A whole file at once; `-` is standard output. Throws InputError.
void write_file(const std::string& path, std::string_view bytes, AtomicFile::Sync sync = AtomicFile::Sync::kNo);

/// Throws InputError when `path` cannot be written, for a file that comes at the end of long work. Changes nothing.
void require_writable(const std::string& path);

}  // namespace pharos::host
