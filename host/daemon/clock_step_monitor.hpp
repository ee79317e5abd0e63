// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/clock/clock_map.hpp"

namespace pharos::host {

/// Reports for a minute that this computer's clock was set, as detected by a ClockMap.
class ClockStepMonitor {
 public:
  /// True when the map has counted a new jump.
  bool update(const ClockMap& map, std::int64_t monotonic_ns);
  /// Readable description of the step; empty after a minute.
  std::string notice(std::int64_t monotonic_ns) const;

 private:
  std::uint64_t seen_ = 0;
  std::int64_t at_ns_ = -1;
  std::int64_t by_ns_ = 0;
};

}  // namespace pharos::host
