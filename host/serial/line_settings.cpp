// SPDX-License-Identifier: Apache-2.0
// The only file that includes the kernel's header, which defines termios2 and conflicts with <termios.h>.
#include "host/serial/line_settings.hpp"

#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstdlib>

namespace pharos::host {
namespace {

/// A UART samples the last of 10 bits half a bit from its edge: 5 % in all, shared by both ends.
constexpr int kSpeedToleranceDivisor = 50;

}  // namespace

int set_raw_line(int fd, int baud) {
  if (baud <= 0) return EINVAL;
  termios2 line{};
  if (::ioctl(fd, TCGETS2, &line) != 0) return errno;
  line.c_iflag = 0;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
  line.c_ispeed = static_cast<speed_t>(baud);
  line.c_ospeed = static_cast<speed_t>(baud);
  // With O_NONBLOCK, no data is EAGAIN, so that a read of 0 bytes always means that the device is gone.
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  if (::ioctl(fd, TCSETS2, &line) != 0) return errno;
  const int given = line_speed(fd);
  return std::abs(given - baud) > baud / kSpeedToleranceDivisor ? EINVAL : 0;
}

int line_speed(int fd) {
  termios2 line{};
  if (::ioctl(fd, TCGETS2, &line) != 0) return 0;
  return static_cast<int>(line.c_ospeed);
}

}  // namespace pharos::host
