// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>

#include "host/support/input_error.hpp"

namespace pharos::tools {

void write_text_file(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text << std::flush;
    return;
  }
  const std::string aside = path + ".new";
  std::ofstream out(aside, std::ios::binary);
  out << text << std::flush;
  if (!out || std::rename(aside.c_str(), path.c_str()) != 0) {
    throw host::InputError(path + ": cannot be written: " + std::strerror(errno) + "; choose another file");
  }
}

}  // namespace pharos::tools
