// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::host {

/// What is wrong with an LCM URL for a daemon that publishes, and what to do; empty when nothing is.
///
/// Taken: `udpm://[address[:port]][?ttl=0..255&recv_buf_size=BYTES]` with a multicast address, and
/// `file://PATH?mode=w` (or `a`). LCM itself takes nearly anything: a misspelt address becomes 0.0.0.0, an unknown
/// option is ignored. Not taken: `tcpq://`, whose send waits for the server and would hold up the poll loop, and
/// `memq://`, which nobody outside this process can hear.
std::string lcm_url_error(const std::string& url);

}  // namespace pharos::host
