// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/file_content.hpp"

#include <fstream>
#include <sstream>

#include "host/support/input_error.hpp"

namespace pharos::tools {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw host::InputError(path.string() + ": cannot be read");
  return text.str();
}

}  // namespace pharos::tools
