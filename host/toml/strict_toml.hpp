// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"

namespace pharos::host {

/// Closed interval that a number in a file must lie in.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

inline constexpr Range kNotNegative{0.0, std::numeric_limits<double>::infinity()};
inline constexpr Range kFraction{0.0, 1.0};

/// A table of a TOML file that is read strictly: wrong types, values out of range and unknown keys are errors
/// (host::InputError) that name file, line and key.
///
/// Reading a key marks it as known. After everything was read, `reject_unknown` on the root checks the whole file.
/// Copies refer to the same table; the file's content exists as long as any of them.
class TomlTable {
 public:
  /// The file's top level (`-`: of standard input). Throws InputError when it cannot be read or is not TOML.
  static TomlTable parse_file(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in messages.
  static TomlTable parse_text(std::string_view text, const std::string& name);

  bool has(std::string_view key) const;

  // Without a fallback the key is required. Integers are accepted as real numbers but not vice versa; infinite and
  // not-a-number values are refused.
  double number(std::string_view key, Range range = {}) const;
  double number_or(std::string_view key, double fallback, Range range = {}) const;
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high) const;
  bool boolean_or(std::string_view key, bool fallback) const;
  std::string text(std::string_view key) const;
  std::string text_or(std::string_view key, const std::string& fallback) const;
  /// One of `words`; the message of a refusal lists them.
  std::string choice(std::string_view key, std::initializer_list<std::string_view> words) const;
  std::string choice_or(std::string_view key, const std::string& fallback,
                        std::initializer_list<std::string_view> words) const;

  /// An array of numbers; empty if the key is absent.
  std::vector<double> numbers(std::string_view key, Range range = {}) const;
  /// An array of exactly N numbers.
  template <std::size_t N>
  std::array<double, N> vector(std::string_view key, Range range = {}) const {
    return to_array<N>(numbers_of_size(key, N, range));
  }
  template <std::size_t N>
  std::array<double, N> vector_or(std::string_view key, const std::array<double, N>& fallback, Range range = {}) const {
    return has(key) ? vector<N>(key, range) : fallback;
  }
  /// An array of arrays of numbers, each `columns` long; empty if the key is absent.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns, Range range = {}) const;
  /// An array of integers; empty if the key is absent.
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high) const;
  /// An array of strings; empty if the key is absent.
  std::vector<std::string> texts(std::string_view key) const;

  /// [key], which is required.
  TomlTable table(std::string_view key) const;
  /// [key], or an empty table (every key absent) if the file has none.
  TomlTable table_or_empty(std::string_view key) const;
  /// Every [[key]] in order; a single [key] counts as one; empty if absent.
  std::vector<TomlTable> tables(std::string_view key) const;

  /// Throws for the first unknown key in this table or in any table read from it; names the known key that it
  /// resembles.
  void reject_unknown() const;
  /// The message of every such key; empty where there is none.
  std::vector<std::string> unknown_keys() const;
  /// Throws "file:line: key: message" for a value that was read but cannot be worked with.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// The message that fail() throws.
  std::string message_of(std::string_view key, const std::string& message) const;
  /// Line of the key in the file, or of the table itself where the key is absent.
  std::uint32_t line_of(std::string_view key) const;
  /// Every key that is in this table, in alphabetical order.
  std::vector<std::string> keys() const;
  const std::string& file() const;

 private:
  struct State;
  explicit TomlTable(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::vector<double> numbers_of_size(std::string_view key, std::size_t size, Range range) const;
  template <std::size_t N>
  static std::array<double, N> to_array(const std::vector<double>& values) {
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i) result[i] = values[i];
    return result;
  }

  std::shared_ptr<State> state_;
};

}  // namespace pharos::host
