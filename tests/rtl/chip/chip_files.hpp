// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host/support/input_error.hpp"

namespace pharos::rtl {

/// All bytes of a file; throws host::InputError where it cannot be read.
inline std::vector<std::uint8_t> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw host::InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Throws host::InputError where the file cannot be written.
inline void write_bytes(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw host::InputError(path + ": cannot be written");
}

}  // namespace pharos::rtl
