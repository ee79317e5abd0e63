// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/section.hpp"

#include <fstream>
#include <iterator>

#include "host/files/atomic_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::tools::report {
namespace {

// What stands before and after the section, the two lines included.
struct Frame {
  std::string before, after;
};

std::size_t only_place_of(std::string_view line, const std::string& document, const std::string& path) {
  const std::string with_end = std::string(line) + "\n";
  const std::size_t place = document.find(with_end);
  const bool begins_a_line = place == 0 || (place != std::string::npos && document[place - 1] == '\n');
  if (!begins_a_line || document.find(line, place + line.size()) != std::string::npos) {
    throw host::InputError(path + ": the line " + std::string(line) + " must stand there once");
  }
  return place;
}

Frame frame_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw host::InputError(path + ": cannot be read");
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = only_place_of(kSectionBegin, document, path);
  const std::size_t end = only_place_of(kSectionEnd, document, path);
  if (end < begin) throw host::InputError(path + ": the section ends before it begins");
  return {document.substr(0, begin + kSectionBegin.size() + 1), document.substr(end)};
}

}  // namespace

void require_section(const std::string& path) {
  frame_of(path);
  host::require_writable(path);
}

void put_section(const std::string& path, std::string_view text) {
  const Frame frame = frame_of(path);
  host::write_file(path, frame.before + "\n" + std::string(text) + "\n" + frame.after);
}

}  // namespace pharos::tools::report
