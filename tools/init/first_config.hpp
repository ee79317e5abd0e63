// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pharos::tools {

/// A board on a serial line, and the target that carries it.
struct FirstTarget {
  std::string name, port, target_file;
  int baud = 460'800;
  std::string serial;          // of the board; empty: any
  std::optional<int> sensors;  // inputs of the board
};

/// A depth camera before a docking ring.
struct FirstCamera {
  std::string name, target, camera_file;
  std::string serial, address;  // one of them at least
};

struct FirstConfig {
  std::vector<FirstTarget> targets;
  std::vector<FirstCamera> cameras;
  std::string state_directory;  // empty: none

  bool empty() const { return targets.empty() && cameras.empty(); }
};

/// Letters, digits, - and _ of `text`; `fallback` where there is none.
std::string config_name(const std::string& text, const std::string& fallback);

/// A configuration of pharosd with these sources, and comments that say what else there is.
std::string config_text(const FirstConfig& config);

}  // namespace pharos::tools
