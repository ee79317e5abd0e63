// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::host {

/// Raw 8N1 at any speed, no flow control, modem lines ignored. Reads give what is there, at least one byte.
///
/// By Linux' termios2, whose speeds are plain numbers: 250,000 or 921,600 as well as 115,200. Returns 0, or the errno
/// of the call that failed; EINVAL also where the driver took another speed than asked for (more than 2 % off: the line
/// would only give garbage).
int set_raw_line(int fd, int baud);

/// Speed that the driver says it uses, baud; 0 where it cannot tell.
int line_speed(int fd);

}  // namespace pharos::host
