// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::host {

/// Arrival time of bytes, on both clocks of this computer (in a replay: the recorded times).
struct Arrival {
  std::int64_t utc_ns = 0;
  std::int64_t monotonic_ns = 0;
};

}  // namespace pharos::host
