// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "host/support/input_error.hpp"

namespace pharos::sim {

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw host::InputError(pattern + ": cannot be made (" + std::strerror(errno) +
                           "); set TMPDIR to a directory that can be written");
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace pharos::sim
