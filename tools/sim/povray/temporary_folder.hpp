// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace pharos::sim {

/// A folder under $TMPDIR that goes with its owner, for files that pass between us and POV-Ray.
class TemporaryFolder {
 public:
  /// `name` is how it begins. Throws host::InputError where it cannot be made.
  explicit TemporaryFolder(const std::string& name);
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace pharos::sim
