// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>

#include "host/support/unique_fd.hpp"

namespace pharos::host::test {

/// A pseudo-terminal: the test holds the target's end, the code under test opens `path` as its serial port.
struct Pty {
  UniqueFd target;
  std::string path;

  Pty() : target(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    std::array<char, 128> name{};
    if (!target.valid() || ::grantpt(target.get()) != 0 || ::unlockpt(target.get()) != 0 ||
        ::ptsname_r(target.get(), name.data(), name.size()) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
    path = name.data();
  }
  void send(std::span<const std::uint8_t> bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::write(target.get(), bytes.data(), bytes.size());
      if (sent <= 0) throw std::runtime_error("pseudo-terminal does not take bytes");
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
  }
  /// The cable is pulled.
  void unplug() { target.reset(); }
};

/// Waits until `fd` is readable (bytes or the end); false after two seconds.
inline bool wait_readable(int fd) {
  pollfd waiting{fd, POLLIN, 0};
  return ::poll(&waiting, 1, 2000) == 1;
}

}  // namespace pharos::host::test
