// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/clock/clock_map.hpp"

namespace pharos::host {

/// Remembers for a minute that somebody set this computer's clock, as a ClockMap saw it.
class ClockStepMonitor {
 public:
  /// True when the map counted a jump that was not seen before.
  bool update(const ClockMap& map, std::int64_t monotonic_ns);
  /// What happened, for people; empty a minute later.
  std::string notice(std::int64_t monotonic_ns) const;

 private:
  std::uint64_t seen_ = 0;
  std::int64_t at_ns_ = -1;
  std::int64_t by_ns_ = 0;
};

}  // namespace pharos::host
