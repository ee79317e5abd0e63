// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::host {

/// Raw 8N1 at any speed, no flow control, modem lines ignored. A read returns the available bytes, at least one.
///
/// Uses Linux' termios2, whose speeds are plain numbers: 250,000 or 921,600 as well as 115,200. Returns 0, or the errno
/// of the call that failed; EINVAL also where the driver set a speed that differs by more than 2 % (the line would only
/// give garbage).
int set_raw_line(int fd, int baud);

/// Speed reported by the driver, baud; 0 where it is unknown.
int line_speed(int fd);

}  // namespace pharos::host
