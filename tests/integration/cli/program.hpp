// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace pharos::cli_test {

/// Results of a run of the program.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `pharos ARGUMENTS` (as a shell would split them) with `input` on standard input.
Outcome pharos(const std::string& arguments, std::string_view input = "");

using Folder = pharos::test::TemporaryFolder;

std::string content_of(const std::string& path);

/// Rows of a CSV text by column name. Every row must have as many fields as the header.
using Row = std::map<std::string, std::string>;
std::vector<Row> rows_of(const std::string& csv);
std::string first_line(const std::string& text);
std::size_t count_lines(const std::string& text);

}  // namespace pharos::cli_test
