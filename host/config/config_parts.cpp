// SPDX-License-Identifier: Apache-2.0
#include "host/config/config_parts.hpp"

#include <algorithm>
#include <cctype>

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxName = 32;     // short enough for log lines and file names
constexpr std::size_t kMaxChannel = 63;  // of LCM

}  // namespace

bool all_of_set(const std::string& text, const char* punctuation) {
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           (c != '\0' && std::string_view(punctuation).find(c) != std::string_view::npos);
  });
}

std::string read_name(const TomlTable& table, std::string_view key, const std::string& name) {
  if (name.empty() || name.size() > kMaxName || !all_of_set(name, "-_")) {
    table.fail(key, "must be 1 to " + std::to_string(kMaxName) + " letters, digits, - or _");
  }
  return name;
}

std::string read_channel(const TomlTable& table, std::string_view key, const std::string& channel) {
  if (channel.empty() || channel.size() > kMaxChannel || !all_of_set(channel, "_")) {
    table.fail(key, "must be 1 to " + std::to_string(kMaxChannel) + " letters, digits or _, as PHAROS_TOF_POSE");
  }
  return channel;
}

fs::path read_path(const TomlTable& table, std::string_view key, const fs::path& folder) {
  const std::string text = table.text(key);
  if (text.empty()) table.fail(key, "is empty; give a path");
  if (text.find('\0') != std::string::npos) table.fail(key, "holds a zero character; give a path");
  return fs::path(text).is_absolute() ? fs::path(text) : folder / text;
}

}  // namespace pharos::host
