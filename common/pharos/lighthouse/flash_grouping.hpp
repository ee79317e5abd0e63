// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/optical_timing.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::lighthouse {

/// Long pulses of several sensors that rise together: one flash, or something that looks like it.
struct FlashGroup {
  StaticVector<Pulse, kMaxSensors> pulses;

  bool empty() const { return pulses.empty(); }
  /// No pulse of this group can fall later.
  std::int64_t deadline_ticks() const { return pulses[0].rise_ticks + kFlashRiseSpreadTicks + kLongestPulseTicks; }
};

/// What a group says as a whole.
struct FlashCandidate {
  std::int64_t start_ticks = 0;   // rise on the strongest sensor
  std::int32_t length_ticks = 0;  // longest pulse
  std::uint8_t sensors = 0;
};

FlashCandidate candidate_of(const FlashGroup& group);

/// Collects long pulses, which come in the order of their falls, to groups. Two groups may be open at once, so that a
/// stray long pulse cannot split a flash in two.
class FlashGrouping {
 public:
  static constexpr std::size_t kOpenGroups = 2;

  /// True when `pulse` found a place; false when both groups are of other times: close the one that first_to_close()
  /// names, then push again.
  bool push(const Pulse& pulse);
  FlashGroup& first_to_close();
  /// Earliest time at which a group is complete; INT64_MAX when none is open.
  std::int64_t deadline_ticks() const { return deadline_; }
  /// Empties `group` (one of this object's) after it was read.
  void close(FlashGroup& group);

 private:
  void refresh_deadline();

  std::array<FlashGroup, kOpenGroups> groups_{};
  std::int64_t deadline_ = INT64_MAX;
};

}  // namespace pharos::lighthouse
