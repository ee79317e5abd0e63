// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <system_error>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A capture board's end of a serial line: the daemon reads the bytes written here from path().
///
/// The destructor disconnects it: the other side gets a hang-up.
class PseudoTerminal {
 public:
  PseudoTerminal() : fd_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (!fd_.valid() || ::grantpt(fd_.get()) != 0 || ::unlockpt(fd_.get()) != 0) {
      throw std::system_error(errno, std::generic_category(), "posix_openpt");
    }
    termios settings{};
    ::tcgetattr(fd_.get(), &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(fd_.get(), TCSANOW, &settings);
    path_ = ::ptsname(fd_.get());
  }

  const std::string& path() const { return path_; }
  int fd() const { return fd_.get(); }

  /// Writes all of it, waiting for the reader where the line's buffer is full; false after five seconds without space.
  bool write(std::span<const std::uint8_t> bytes) const {
    constexpr int kTimeout_ms = 5000;
    while (!bytes.empty()) {
      pollfd room{fd_.get(), POLLOUT, 0};
      if (::poll(&room, 1, kTimeout_ms) <= 0) return false;
      const ssize_t written = ::write(fd_.get(), bytes.data(), bytes.size());
      if (written <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
  }

 private:
  UniqueFd fd_;
  std::string path_;
};

}  // namespace pharos::host
