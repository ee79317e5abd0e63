// SPDX-License-Identifier: Apache-2.0
#include "tools/init/first_config.hpp"

#include <array>
#include <cctype>
#include <cstdio>

namespace pharos::tools {
namespace {

// A basic string of TOML.
std::string quoted_toml(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (code < 0x20 || code == 0x7F) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04X", code);
      out += escape.data();
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string line(const char* key, const std::string& value) {
  return std::string(key) + " = " + quoted_toml(value) + '\n';
}

std::string text_of(const FirstTarget& target) {
  std::string out = "\n[[target]]\n" + line("name", target.name) + line("port", target.port);
  out += "baud = " + std::to_string(target.baud) + '\n' + line("target_file", target.target_file);
  out += "# Output of `pharos calibrate lighthouse`, when there is one:\n#calibration_file = \"calibrated.toml\"\n";
  if (target.serial.empty() && !target.sensors) return out;
  out += "\n# The board that greeted on this port; another one is refused.\n[target.identity]\n";
  if (!target.serial.empty()) out += line("serial", target.serial);
  if (target.sensors) out += "sensors = " + std::to_string(*target.sensors) + '\n';
  return out;
}

std::string text_of(const FirstCamera& camera) {
  std::string out = "\n[[camera]]\n" + line("name", camera.name) + line("target", camera.target);
  out += line("camera_file", camera.camera_file);
  if (!camera.serial.empty()) out += line("serial", camera.serial);
  if (!camera.address.empty()) out += line("address", camera.address);
  return out;
}

}  // namespace

std::string config_name(const std::string& text, const std::string& fallback) {
  std::string name;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') name += c;
  }
  return name.empty() ? fallback : name;
}

std::string config_text(const FirstConfig& config) {
  std::string out =
      "# Written by `pharos init`. Every other key has its default value: see /etc/pharos/pharosd.toml or the example\n"
      "# that ships. Check after a change: pharosd --check FILE\n";
  if (!config.state_directory.empty()) out += line("state_directory", config.state_directory);
  for (const FirstTarget& target : config.targets) out += text_of(target);
  for (const FirstCamera& camera : config.cameras) out += text_of(camera);
  return out;
}

}  // namespace pharos::tools
