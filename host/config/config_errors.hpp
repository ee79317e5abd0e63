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
      if (std::find(lines_.begin(), lines_.end(), error.what()) == lines_.end()) lines_.emplace_back(error.what());
      return false;
    }
  }
  /// Refuses unknown keys. After an error, nested tables may not have been read to their end, and their keys would look
  /// unknown: with errors since `before` only the table's own keys are checked.
  void reject_unknown(const TomlTable& table, std::size_t before) {
    const bool whole = count() == before;
    attempt([&] { whole ? table.reject_unknown() : table.reject_unknown_here(); });
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
