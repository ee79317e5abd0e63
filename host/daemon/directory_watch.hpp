// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Tells of files that have become whole in a directory: closed after writing, or moved there (inotify).
///
/// Hidden files (".name": AtomicFile, rsync and others write under such names) and what was there before are not
/// reported. A directory that is not there (yet, or any more) is looked for by attend().
class DirectoryWatch {
 public:
  /// Throws std::system_error where the kernel gives no inotify descriptor.
  explicit DirectoryWatch(std::filesystem::path directory);

  /// Readable when there is something to take().
  int fd() const { return inotify_.get(); }
  /// Watches the directory if it is not watched; call now and then.
  void attend();
  /// Names of the files that are whole now.
  std::vector<std::string> take();

  bool watching() const { return watch_ >= 0; }
  /// Why it is not watched, for a person; empty when it is.
  const std::string& error() const { return error_; }
  /// How often the kernel's queue overflowed: names were lost.
  int overflows() const { return overflows_; }

 private:
  std::filesystem::path directory_;
  UniqueFd inotify_;
  int watch_ = -1;
  std::string error_;
  int overflows_ = 0;
};

}  // namespace pharos::host
