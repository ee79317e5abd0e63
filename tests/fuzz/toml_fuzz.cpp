// SPDX-License-Identifier: Apache-2.0
#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/toml/strict_toml.hpp"
#include "host/toml/toml_limits.hpp"
#include "support/require.hpp"

namespace {

using pharos::host::kMaxTomlKeyParts;
using pharos::host::kMaxTomlNesting;
using pharos::test::require;

// Levels of a tree, without descending into it.
std::size_t depth_of(const toml::table& root) {
  std::size_t deepest = 0;
  std::vector<std::pair<const toml::node*, std::size_t>> open{{&root, 0}};
  while (!open.empty()) {
    const auto [node, depth] = open.back();
    open.pop_back();
    deepest = depth > deepest ? depth : deepest;
    if (const toml::table* table = node->as_table()) {
      for (const auto& [key, child] : *table) open.emplace_back(&child, depth + 1);
    } else if (const toml::array* array = node->as_array()) {
      for (const toml::node& child : *array) open.emplace_back(&child, depth + 1);
    }
  }
  return deepest;
}

}  // namespace

// Any text is either a table whose tree is as shallow as the limits say, or an InputError of one line; and what is
// within the limits as the parser reads it is within them as they are counted.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto root = pharos::host::TomlTable::parse_text(text, "fuzz.toml");
    const toml::table tree = toml::parse(text);
    // A table's name, and at each level of nesting an array's element and a dotted key.
    require(depth_of(tree) <= 2 * kMaxTomlKeyParts + kMaxTomlNesting * (kMaxTomlKeyParts + 1));
    require(root.keys().size() == tree.size());
    root.reject_unknown();
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz.toml:") && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
