// SPDX-License-Identifier: Apache-2.0
#include "host/toml/strict_toml.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "host/support/nearest_name.hpp"
#include "host/toml/toml_limits.hpp"

namespace pharos::host {

struct TomlTable::State {
  std::shared_ptr<const toml::table> root;  // keeps the nodes alive
  const toml::table* table = nullptr;       // null: the table is absent
  std::string file;
  std::string path;  // "station[1].rotor_x.", empty at top level
  std::uint32_t line = 0;
  mutable std::set<std::string, std::less<>> asked;
  mutable std::map<std::string, std::shared_ptr<State>, std::less<>> children;

  const toml::node* find(std::string_view key) const {
    asked.emplace(key);
    return table == nullptr ? nullptr : table->get(key);
  }
};

namespace {

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string describe(Range range) {
  if (std::isinf(range.high)) return "must be at least " + shown(range.low);
  if (std::isinf(range.low)) return "must be at most " + shown(range.high);
  return "must lie in " + shown(range.low) + " to " + shown(range.high);
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

/// The parser's messages quote unexpected text, including line breaks.
std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return line;
}

}  // namespace

TomlTable TomlTable::parse_text(std::string_view text, const std::string& name) {
  if (const auto excess = toml_excess(text)) {
    throw InputError(name + ":" + std::to_string(excess->line) + ": holds " + excess->what +
                     "; no file of Pharos does");
  }
  auto state = std::make_shared<TomlTable::State>();
  try {
    state->root = std::make_shared<const toml::table>(toml::parse(text, name));
  } catch (const toml::parse_error& error) {
    throw InputError(name + ":" + std::to_string(error.source().begin.line) +
                     ": not valid TOML: " + on_one_line(error.description()));
  }
  state->table = state->root.get();
  state->file = name;
  state->line = 1;
  return TomlTable(std::move(state));
}

namespace {

// One byte more than the limit is enough to detect an excess.
std::string read_some(std::istream& in) {
  std::string content(kMaxTomlBytes + 1, '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  return content;
}

}  // namespace

TomlTable TomlTable::parse_file(const std::filesystem::path& path) {
  if (path == "-") return parse_text(read_some(std::cin), "standard input");
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path.string() + ": is a directory, not a TOML file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be opened; check the path and its permissions");
  const std::string content = read_some(in);
  if (in.bad()) throw InputError(path.string() + ": cannot be read");
  return parse_text(content, path.string());
}

bool TomlTable::has(std::string_view key) const { return state_->find(key) != nullptr; }
const std::string& TomlTable::file() const { return state_->file; }

std::uint32_t TomlTable::line_of(std::string_view key) const {
  const toml::node* node = state_->find(key);
  return node == nullptr ? state_->line : static_cast<std::uint32_t>(node->source().begin.line);
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> result;
  if (state_->table != nullptr) {
    for (const auto& [key, node] : *state_->table) result.emplace_back(key.str());
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string TomlTable::message_of(std::string_view key, const std::string& message) const {
  return state_->file + ":" + std::to_string(line_of(key)) + ": " +
         on_one_line(state_->path + std::string(key) + ": " + message);
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  throw InputError(message_of(key, message));
}

double TomlTable::number(std::string_view key, Range range) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) fail(key, "is missing");
  if (!node->is_number()) fail(key, "must be a number, not " + type_name(*node));
  const double value = *node->value<double>();
  if (!std::isfinite(value)) fail(key, "must be a finite number");
  if (value < range.low || value > range.high) fail(key, describe(range) + ", not " + shown(value));
  return value;
}

double TomlTable::number_or(std::string_view key, double fallback, Range range) const {
  return has(key) ? number(key, range) : fallback;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) fail(key, "is missing");
  if (!node->is_integer()) fail(key, "must be an integer, not " + type_name(*node));
  const std::int64_t value = **node->as_integer();
  if (value < low || value > high) {
    fail(key, "must lie in " + std::to_string(low) + " to " + std::to_string(high) + ", not " + std::to_string(value));
  }
  return value;
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t fallback, std::int64_t low,
                                   std::int64_t high) const {
  return has(key) ? integer(key, low, high) : fallback;
}

bool TomlTable::boolean_or(std::string_view key, bool fallback) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) fail(key, "must be true or false, not " + type_name(*node));
  return **node->as_boolean();
}

std::string TomlTable::text(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) fail(key, "is missing");
  if (!node->is_string()) fail(key, "must be a string, not " + type_name(*node));
  return **node->as_string();
}

std::string TomlTable::text_or(std::string_view key, const std::string& fallback) const {
  return has(key) ? text(key) : fallback;
}

std::string TomlTable::choice(std::string_view key, std::initializer_list<std::string_view> words) const {
  const std::string value = text(key);
  if (std::find(words.begin(), words.end(), value) != words.end()) return value;
  std::string list;
  for (const std::string_view word : words) list += (list.empty() ? "" : ", ") + std::string(word);
  fail(key, "must be one of " + list + ", not \"" + value + "\"");
}

std::string TomlTable::choice_or(std::string_view key, const std::string& fallback,
                                 std::initializer_list<std::string_view> words) const {
  return has(key) ? choice(key, words) : fallback;
}

std::vector<double> TomlTable::numbers(std::string_view key, Range range) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) fail(key, "must be an array of numbers, not " + type_name(*node));
  std::vector<double> result;
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_number()) fail(key, "must hold numbers only, not " + type_name(element));
    const double value = *element.value<double>();
    if (!std::isfinite(value)) fail(key, "must hold finite numbers only");
    if (value < range.low || value > range.high) fail(key, "each " + describe(range) + ", not " + shown(value));
    result.push_back(value);
  }
  return result;
}

std::vector<double> TomlTable::numbers_of_size(std::string_view key, std::size_t size, Range range) const {
  if (!has(key)) fail(key, "is missing");
  std::vector<double> result = numbers(key, range);
  if (result.size() != size) {
    fail(key, "must hold " + std::to_string(size) + " numbers, not " + std::to_string(result.size()));
  }
  return result;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, std::size_t columns, Range range) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) fail(key, "must be an array of rows, not " + type_name(*node));
  std::vector<std::vector<double>> result;
  for (const toml::node& row : *node->as_array()) {
    const std::string which = "row " + std::to_string(result.size() + 1) + " ";
    if (!row.is_array() || row.as_array()->size() != columns) {
      fail(key, which + "must be an array of " + std::to_string(columns) + " numbers");
    }
    std::vector<double> values;
    for (const toml::node& element : *row.as_array()) {
      if (!element.is_number()) fail(key, which + "must hold numbers only, not " + type_name(element));
      values.push_back(*element.value<double>());
      if (!std::isfinite(values.back()) || values.back() < range.low || values.back() > range.high) {
        fail(key, which + "holds a number out of range: " + shown(values.back()));
      }
    }
    result.push_back(std::move(values));
  }
  return result;
}

std::vector<std::int64_t> TomlTable::integers(std::string_view key, std::int64_t low, std::int64_t high) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) fail(key, "must be an array of integers, not " + type_name(*node));
  std::vector<std::int64_t> result;
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_integer()) fail(key, "must hold integers only, not " + type_name(element));
    const std::int64_t value = **element.as_integer();
    if (value < low || value > high) {
      fail(key, "each must lie in " + std::to_string(low) + " to " + std::to_string(high) + ", not " +
                    std::to_string(value));
    }
    result.push_back(value);
  }
  return result;
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) fail(key, "must be an array of strings, not " + type_name(*node));
  std::vector<std::string> result;
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_string()) fail(key, "must hold strings only, not " + type_name(element));
    result.push_back(**element.as_string());
  }
  return result;
}

TomlTable TomlTable::table_or_empty(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node != nullptr && !node->is_table()) fail(key, "must be a table, not " + type_name(*node));
  std::shared_ptr<TomlTable::State>& child = state_->children[std::string(key)];
  if (!child) {
    child = std::make_shared<TomlTable::State>();
    child->root = state_->root;
    child->table = node == nullptr ? nullptr : node->as_table();
    child->file = state_->file;
    child->path = state_->path + std::string(key) + ".";
    child->line = line_of(key);
  }
  return TomlTable(child);
}

TomlTable TomlTable::table(std::string_view key) const {
  if (!has(key)) fail(key, "this table is missing");
  return table_or_empty(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  if (node->is_table()) return {table(key)};
  if (!node->is_array()) fail(key, "must be a table, not " + type_name(*node));
  std::vector<TomlTable> result;
  for (const toml::node& element : *node->as_array()) {
    const std::string name = std::string(key) + "[" + std::to_string(result.size()) + "]";
    if (!element.is_table()) fail(key, "must hold tables only, not " + type_name(element));
    std::shared_ptr<TomlTable::State>& child = state_->children[name];
    if (!child) {
      child = std::make_shared<TomlTable::State>();
      child->root = state_->root;
      child->table = element.as_table();
      child->file = state_->file;
      child->path = state_->path + name + ".";
      child->line = static_cast<std::uint32_t>(element.source().begin.line);
    }
    result.push_back(TomlTable(child));
  }
  return result;
}

std::vector<std::string> TomlTable::unknown_keys() const {
  std::vector<std::string> messages;
  const std::set<std::string, std::less<>> known = state_->asked;  // a line asked for is no key asked for
  for (const std::string& key : keys()) {
    if (known.contains(key)) continue;
    const std::string like = nearest_name(key, known);
    messages.push_back(message_of(key, "unknown key" + (like.empty() ? "" : "; did you mean \"" + like + "\"?")));
  }
  for (const auto& [name, child] : state_->children) {
    const std::vector<std::string> below = TomlTable(child).unknown_keys();
    messages.insert(messages.end(), below.begin(), below.end());
  }
  state_->asked = known;
  return messages;
}

void TomlTable::reject_unknown() const {
  const std::vector<std::string> messages = unknown_keys();
  if (!messages.empty()) throw InputError(messages.front());
}

}  // namespace pharos::host
