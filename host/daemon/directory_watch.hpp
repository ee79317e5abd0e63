// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Reports files that are complete in a directory: closed after writing, or moved there (inotify).
///
/// Hidden files (".name": AtomicFile, rsync and others write under such names) and files that existed before are not
/// reported. attend() looks for a directory that does not exist (yet, or any more).
class DirectoryWatch {
 public:
  /// Throws std::system_error if no inotify descriptor can be created.
  explicit DirectoryWatch(std::filesystem::path directory);

  /// Readable when take() has names.
  int fd() const { return inotify_.get(); }
  /// Starts watching if the directory is not watched; to be called regularly.
  void attend();
  /// Names of the files that have become complete.
  std::vector<std::string> take();

  bool watching() const { return watch_ >= 0; }
  /// Readable reason why the directory is not watched; empty when it is.
  const std::string& error() const { return error_; }
  /// Number of overflows of the kernel's queue, at which names were lost.
  int overflows() const { return overflows_; }

 private:
  std::filesystem::path directory_;
  UniqueFd inotify_;
  int watch_ = -1;
  std::string error_;
  int overflows_ = 0;
};

}  // namespace pharos::host
