// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::host {

/// When bytes arrived, on both clocks of this computer (of a replay: as they were when it was recorded).
struct Arrival {
  std::int64_t utc_ns = 0;
  std::int64_t monotonic_ns = 0;
};

}  // namespace pharos::host
