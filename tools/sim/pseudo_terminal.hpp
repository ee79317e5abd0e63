// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::sim {

/// One end of a serial line whose other end programs open by path, as they would a real port.
///
/// Nobody has to be there: bytes written while no program has the port open are lost, as on a real line. A symbolic
/// link gives the port a name that stays the same when it is unplugged and comes back.
class PseudoTerminal {
 public:
  /// `link` empty: no link. Throws host::InputError when the link's place is taken by something else.
  explicit PseudoTerminal(std::filesystem::path link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// The port's path, or empty while unplugged.
  const std::string& path() const { return path_; }
  /// Whether a program has the port open.
  bool opened() const;
  /// Bytes taken, at most as many as the kernel's buffer holds; all of them, and lost, while nobody listens.
  std::size_t write(std::span<const std::uint8_t> bytes);
  /// What the other side sent since the last call.
  std::vector<std::uint8_t> read();

  /// The port vanishes, its link too.
  void unplug();
  void plug_in();

 private:
  std::filesystem::path link_;
  std::string path_;
  host::UniqueFd master_;
};

}  // namespace pharos::sim
