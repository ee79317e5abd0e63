// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "tests/support/temporary_file.hpp"

namespace pharos::test {

inline std::string gzipped(std::string_view content) {
  const TemporaryFile file;
  gzFile out = gzopen(file.path().c_str(), "wb");
  gzwrite(out, content.data(), static_cast<unsigned>(content.size()));
  gzclose(out);
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace pharos::test
