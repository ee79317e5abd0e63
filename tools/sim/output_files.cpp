// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/output_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/files/atomic_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::sim {

void refuse_output(const std::filesystem::path& path) {
  throw host::InputError(path.string() + ": cannot be written: " + std::strerror(errno) + "; choose another --output");
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw host::InputError(folder.string() + ": cannot be made: " + error.message() + "; choose another --output");
  }
}

void write_output(const std::filesystem::path& path, std::string_view bytes) { host::write_file(path.string(), bytes); }

std::string padded_number(std::size_t index, std::size_t digits) {
  const std::string number = std::to_string(index);
  return std::string(std::max(digits, number.size()) - number.size(), '0') + number;
}

std::string file_number(std::size_t index, std::size_t count) {
  return padded_number(index, std::max<std::size_t>(4, std::to_string(count - 1).size()));
}

TableFile::TableFile(const std::filesystem::path& path, std::vector<std::string> columns)
    : file_(std::fopen(path.c_str(), "w"), &std::fclose) {
  if (!file_) refuse_output(path);
  rows_ = std::make_unique<host::RowWriter>(file_.get(), host::RowFormat::kCsv, std::move(columns));
}

}  // namespace pharos::sim
