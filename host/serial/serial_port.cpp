// SPDX-License-Identifier: Apache-2.0
#include "host/serial/serial_port.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/serial/line_settings.hpp"

namespace pharos::host {
namespace {

OpenFailure failure(OpenError error, const std::string& path, const std::string& text) {
  return {error, path + ": " + text};
}

OpenFailure busy(const std::string& path) {
  return failure(OpenError::kBusy, path, "in use by another program; stop it (fuser -v " + path + " names it)");
}

OpenFailure why_not_opened(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
    case EIO:
    case ENOTDIR:
      return failure(OpenError::kMissing, path, "no such device; check the cable and the name (ls /dev/serial/by-id)");
    case EACCES:
    case EPERM:
      return failure(OpenError::kNoPermission, path,
                     "no permission; add the user to the group that owns the port (usually: adduser USER dialout, "
                     "then log in again)");
    case EBUSY:
      return busy(path);
    case EISDIR:
      return failure(OpenError::kNotATerminal, path, "is a folder, not a serial port");
    default:
      return failure(OpenError::kOther, path, std::string("cannot be opened: ") + std::strerror(error));
  }
}

Transfer transferred(ssize_t result) {
  if (result > 0) return {static_cast<std::size_t>(result), false};
  if (result < 0 && (errno == EAGAIN || errno == EINTR)) return {0, false};
  return {0, true};
}

}  // namespace

Result<SerialPort, OpenFailure> SerialPort::open(const std::string& path, int baud) {
  UniqueFd fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!fd.valid()) return why_not_opened(path, errno);
  if (::isatty(fd.get()) == 0) return failure(OpenError::kNotATerminal, path, "is not a serial port (not a terminal)");
  // Two locks: TIOCEXCL stops every later open but root's, flock those of root and of other well-behaved programs.
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) return busy(path);
  if (::ioctl(fd.get(), TIOCEXCL) != 0) return why_not_opened(path, errno);
  SerialPort port(std::move(fd));
  if (const int error = set_raw_line(port.fd(), baud); error == EINVAL) {
    return failure(OpenError::kBadSpeed, path,
                   "does not do " + std::to_string(baud) + " baud (it offers " + std::to_string(line_speed(port.fd())) +
                       "); choose another speed on both ends");
  } else if (error != 0) {
    return why_not_opened(path, error);
  }
  return port;
}

SerialPort& SerialPort::operator=(SerialPort&& other) noexcept {
  if (this != &other) {
    close();
    fd_ = std::move(other.fd_);
  }
  return *this;
}

void SerialPort::close() {
  // A pseudo-terminal exists longer than its last user and would stay exclusive for ever.
  if (fd_.valid()) (void)::ioctl(fd_.get(), TIOCNXCL);
  fd_.reset();
}

Transfer SerialPort::read(std::span<std::uint8_t> out) {
  if (out.empty()) return {};
  return transferred(::read(fd_.get(), out.data(), out.size()));
}

Transfer SerialPort::write(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return {};
  return transferred(::write(fd_.get(), bytes.data(), bytes.size()));
}

}  // namespace pharos::host
