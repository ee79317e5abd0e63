// SPDX-License-Identifier: Apache-2.0
#include "host/toml/toml_limits.hpp"

namespace pharos::host {
namespace {

class Scan {
 public:
  explicit Scan(std::string_view text) : text_(text) {}

  std::optional<TomlExcess> excess() {
    while (at_ < text_.size()) {
      take(text_[at_]);
      if (nesting_ > kMaxTomlNesting) {
        return TomlExcess{line_, "more than " + std::to_string(kMaxTomlNesting) + " arrays or tables in one another"};
      }
      if (dots_ >= kMaxTomlKeyParts) {
        return TomlExcess{line_, "a key of more than " + std::to_string(kMaxTomlKeyParts) + " parts"};
      }
    }
    return std::nullopt;
  }

 private:
  // Dots in values are counted too: no number, date or word has as many.
  void take(char c) {
    if (c == '#') return skip_comment();
    if (c == '"' || c == '\'') return skip_string(c);
    ++at_;
    if (c == '.') {
      ++dots_;
    } else if (c == '[' || c == '{') {
      ++nesting_;
      dots_ = 0;
    } else if (c == ']' || c == '}') {
      if (nesting_ > 0) --nesting_;
      dots_ = 0;
    } else if (c == ',' || c == '=' || c == '\n') {
      dots_ = 0;
    }
    if (c == '\n') ++line_;
  }

  void skip_comment() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end;
  }

  // A single-line string ends with its line at the latest, where the parser stops.
  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool many_lines = text_.substr(at_, 3) == triple;
    at_ += many_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n' && !many_lines) return;
      if (c == '\n') ++line_;
      if (quote == '"' && c == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
        ++at_;
      } else if (c == quote && !many_lines) {
        ++at_;
        return;
      } else if (c == quote && text_.substr(at_, 3) == triple) {
        return skip_closing(quote);
      }
    }
  }

  // Up to two quotes before the closing three belong to the string.
  void skip_closing(char quote) {
    at_ += 3;
    for (int own = 0; own < 2 && at_ < text_.size() && text_[at_] == quote; ++own) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  std::size_t nesting_ = 0;
  std::size_t dots_ = 0;  // since the last separator
};

}  // namespace

std::optional<TomlExcess> toml_excess(std::string_view text) {
  if (text.size() > kMaxTomlBytes) {
    return TomlExcess{1, "more than " + std::to_string(kMaxTomlBytes >> 20) + " MiB"};
  }
  return Scan(text).excess();
}

}  // namespace pharos::host
