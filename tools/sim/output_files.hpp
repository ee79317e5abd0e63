// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/table/row_writer.hpp"

namespace pharos::sim {

/// Throws host::InputError: `path` cannot be written, for errno's reason.
[[noreturn]] void refuse_output(const std::filesystem::path& path);

/// Creates `folder` and its parents if they are missing. Throws host::InputError.
void make_output_folder(const std::filesystem::path& folder);

/// Writes a whole file. Throws host::InputError.
void write_output(const std::filesystem::path& path, std::string_view bytes);

/// `index` with at least so many digits.
std::string padded_number(std::size_t index, std::size_t digits);
/// The number of a file of `count` files: four digits, or more if needed, so that names sort in the order of the files.
std::string file_number(std::size_t index, std::size_t count);

/// A CSV file of a simulator's output, written row by row. Throws host::InputError if it cannot be created.
class TableFile {
 public:
  TableFile(const std::filesystem::path& path, std::vector<std::string> columns);
  host::RowWriter& rows() { return *rows_; }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<host::RowWriter> rows_;
};

}  // namespace pharos::sim
