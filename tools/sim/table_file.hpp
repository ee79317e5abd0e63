// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/table/row_writer.hpp"

namespace pharos::sim {

[[noreturn]] inline void refuse_output(const std::filesystem::path& path) {
  throw host::InputError(path.string() + ": cannot be written: " + std::strerror(errno) + "; choose another --output");
}

/// A CSV file of a simulator's output that grows row by row. Throws host::InputError where it cannot be made.
class TableFile {
 public:
  TableFile(const std::filesystem::path& path, std::vector<std::string> columns)
      : file_(std::fopen(path.c_str(), "w"), &std::fclose) {
    if (!file_) refuse_output(path);
    rows_ = std::make_unique<host::RowWriter>(file_.get(), host::RowFormat::kCsv, std::move(columns));
  }
  host::RowWriter& rows() { return *rows_; }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<host::RowWriter> rows_;
};

}  // namespace pharos::sim
