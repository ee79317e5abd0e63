// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::sim {

/// One end of a serial line whose other end programs open by path, like a real port.
///
/// Bytes written while no program has the port open are lost, as on a real line. A symbolic link gives the port a name
/// that stays the same when it is disconnected and comes back.
class PseudoTerminal {
 public:
  /// `link` empty: no link. Throws host::InputError if something other than a link exists at its path.
  explicit PseudoTerminal(std::filesystem::path link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// The port's path, or empty while unplugged.
  const std::string& path() const { return path_; }
  /// Whether a program has the port open.
  bool opened() const;
  /// Number of bytes accepted, limited by the kernel's buffer; while the port is not open all are accepted and lost.
  std::size_t write(std::span<const std::uint8_t> bytes);
  /// Bytes that the other side sent since the last call.
  std::vector<std::uint8_t> read();

  /// Removes the port and its link.
  void unplug();
  void plug_in();

 private:
  std::filesystem::path link_;
  std::string path_;
  host::UniqueFd master_;
};

}  // namespace pharos::sim
