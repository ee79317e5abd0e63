// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/optical_timing.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::lighthouse {

/// Long pulses of several sensors that rise together: a flash, or something similar.
class FlashGroup {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  Pulse operator[](std::size_t k) const {
    return {first_rise_ticks_ + rise_after_first_[k], width_ticks_[k], sensor_[k]};
  }
  /// Of the longest pulse, the first of several; there must be one.
  std::size_t longest() const;
  /// Whether it rises with the others; the first of a group always does.
  bool rises_with(const Pulse& pulse) const {
    constexpr auto kSpread = static_cast<std::uint64_t>(kFlashRiseSpread_ticks);
    return static_cast<std::uint64_t>(pulse.rise_ticks - first_rise_ticks_) + kSpread <= 2 * kSpread;
  }
  /// `pulse` rises with the others, or is the first; false when full.
  bool push(const Pulse& pulse) {
    if (empty()) first_rise_ticks_ = pulse.rise_ticks;
    if (size_ == kMaxSensors) return false;
    rise_after_first_[size_] = static_cast<std::int16_t>(pulse.rise_ticks - first_rise_ticks_);
    width_ticks_[size_] = static_cast<std::uint16_t>(pulse.width_ticks);
    sensor_[size_] = pulse.sensor;
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }
  /// No pulse of this group can fall later.
  std::int64_t deadline_ticks() const { return first_rise_ticks_ + kFlashRiseSpread_ticks + kLongestPulse_ticks; }

 private:
  std::int64_t first_rise_ticks_ = 0;
  std::size_t size_ = 0;
  // Of each pulse; two arrays, as a struct would take five bytes.
  std::array<std::int16_t, kMaxSensors> rise_after_first_{};  // within +-kFlashRiseSpread_ticks
  std::array<std::uint16_t, kMaxSensors> width_ticks_{};
  std::array<std::uint8_t, kMaxSensors> sensor_{};
};

/// Summary of a group.
struct FlashCandidate {
  std::int64_t start_ticks = 0;   // rise on the strongest sensor
  std::int32_t length_ticks = 0;  // longest pulse
  std::uint32_t sensors = 0;
};

FlashCandidate candidate_of(const FlashGroup& group);

/// Collects long pulses, which arrive in the order of their falls, to groups. Two groups may be open at once, so that a
/// stray long pulse cannot split a flash in two.
class FlashGrouping {
 public:
  static constexpr std::size_t kOpenGroups = 2;

  /// True when `pulse` rises with a group that is open and not full.
  bool join(const Pulse& pulse) {
    for (FlashGroup& group : groups_) {
      if (!group.empty() && group.rises_with(pulse) && group.push(pulse)) return true;
    }
    return false;
  }
  /// `pulse`, which joined none, opens a group; false when none is free: close the one that first_to_close() names, and
  /// call it again.
  bool open(const Pulse& pulse);
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
