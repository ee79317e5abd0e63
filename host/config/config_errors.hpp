// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Collects all errors of a configuration, so that one run reports them all.
class ConfigErrors {
 public:
  /// Reads one part and stores the message of an InputError. False after an error; the part then has its default.
  template <class Read>
  bool attempt(Read&& read) {
    try {
      read();
      return true;
    } catch (const InputError& error) {
      add(error.what());
      return false;
    }
  }
  /// Every key that nobody asked for. So all keys of a table must be asked for, whatever is wrong with some of them.
  void add_unknown_keys(const TomlTable& table) {
    for (const std::string& message : table.unknown_keys()) add(message);
  }
  void add(const std::string& line) {
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  std::size_t count() const { return lines_.size(); }
  /// Throws all errors as one InputError, one line each; does nothing if there are none.
  void throw_all() const {
    std::string text;
    for (const std::string& line : lines_) text += (text.empty() ? "" : "\n") + line;
    if (!lines_.empty()) throw InputError(text);
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace pharos::host
