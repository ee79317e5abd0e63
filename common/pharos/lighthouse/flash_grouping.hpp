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
class FlashGroup {
 public:
  bool empty() const { return pulses_.empty(); }
  std::size_t size() const { return pulses_.size(); }
  Pulse operator[](std::size_t k) const {
    return {first_rise_ticks_ + pulses_[k].rise_after_first, pulses_[k].width_ticks, pulses_[k].sensor};
  }
  /// Whether it rises with the others; the first of a group always does.
  bool rises_with(const Pulse& pulse) const {
    const std::int64_t apart = pulse.rise_ticks - first_rise_ticks_;
    return apart <= kFlashRiseSpreadTicks && apart >= -kFlashRiseSpreadTicks;
  }
  /// `pulse` rises with the others, or is the first; false when full.
  bool push(const Pulse& pulse) {
    if (empty()) first_rise_ticks_ = pulse.rise_ticks;
    return pulses_.push_back({static_cast<std::int16_t>(pulse.rise_ticks - first_rise_ticks_),
                              static_cast<std::uint16_t>(pulse.width_ticks), pulse.sensor});
  }
  void clear() { pulses_.clear(); }
  /// No pulse of this group can fall later.
  std::int64_t deadline_ticks() const { return first_rise_ticks_ + kFlashRiseSpreadTicks + kLongestPulseTicks; }

 private:
  struct LongPulse {
    std::int16_t rise_after_first = 0;  // within +-kFlashRiseSpreadTicks
    std::uint16_t width_ticks = 0;
    std::uint8_t sensor = 0;
  };
  StaticVector<LongPulse, kMaxSensors> pulses_;
  std::int64_t first_rise_ticks_ = 0;
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
