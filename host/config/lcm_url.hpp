// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::host {

/// The error of an LCM URL for a daemon that publishes, and what to do; empty for a valid URL.
///
/// Accepted: `udpm://[address[:port]][?ttl=0..255&recv_buf_size=BYTES]` with a multicast address, and
/// `file://PATH?mode=w` (or `a`). LCM itself hardly checks: a misspelt address becomes 0.0.0.0, an unknown option is
/// ignored. Refused: `tcpq://`, whose send waits for the server and would block the event loop, and `memq://`, which
/// stays within this process.
std::string lcm_url_error(const std::string& url);

}  // namespace pharos::host
