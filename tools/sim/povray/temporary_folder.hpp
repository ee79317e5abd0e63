// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace pharos::sim {

/// A folder under $TMPDIR that is removed with its owner, for files exchanged with POV-Ray.
class TemporaryFolder {
 public:
  /// Its name begins with `name`. Throws host::InputError if it cannot be created.
  explicit TemporaryFolder(const std::string& name);
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace pharos::sim
