// SPDX-License-Identifier: Apache-2.0
#include "host/files/same_file.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <system_error>

namespace pharos::host {

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty() || a == "-" || b == "-") return false;
  struct stat of_a {};
  struct stat of_b {};
  const bool a_exists = ::stat(a.c_str(), &of_a) == 0;
  const bool b_exists = ::stat(b.c_str(), &of_b) == 0;
  if (a_exists != b_exists) return false;
  if (a_exists) {
    const bool kept = S_ISREG(of_a.st_mode) || S_ISDIR(of_a.st_mode);
    return kept && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
  }
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
  return !error && first == fs::weakly_canonical(fs::absolute(b, error), error);
}

}  // namespace pharos::host
