// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Everything that is wrong with a configuration, not only the first.
class ConfigErrors {
 public:
  /// Reads one part and keeps what it throws. False where it threw; the part then has its default.
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
  /// Refuses keys that nobody asked for. A part that was not read to its end has some: with errors since `before` only
  /// the table's own keys are looked at, all of which must have been asked for.
  void reject_unknown(const TomlTable& table, std::size_t before) {
    const bool whole = count() == before;
    attempt([&] { whole ? table.reject_unknown() : table.reject_unknown_here(); });
  }
  std::size_t count() const { return lines_.size(); }
  /// Throws all of them as one InputError, a line each; nothing where there is none.
  void throw_all() const {
    std::string text;
    for (const std::string& line : lines_) text += (text.empty() ? "" : "\n") + line;
    if (!lines_.empty()) throw InputError(text);
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace pharos::host
