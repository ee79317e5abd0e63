// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace pharos::test {

/// A file with the given content, removed by the destructor.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view content = "") {
    std::string name = ::testing::TempDir() + "pharos_XXXXXX";
    const int fd = ::mkstemp(name.data());
    if (fd >= 0) ::close(fd);
    path_ = name;
    write(content);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  const std::string& path() const { return path_; }
  /// Replaces the content.
  void write(std::string_view content) const { std::ofstream(path_, std::ios::binary) << content; }

 private:
  std::string path_;
};

}  // namespace pharos::test
