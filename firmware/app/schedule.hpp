// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/ticks.hpp"

namespace pharos::app {

/// Periodic messages: one at a time, so that none of them delays sweeps for long.
enum class Due : std::uint8_t { kNothing, kHello, kDecoderCounters, kDeviceCounters, kTime };

/// Determines when Hello and counters (once a second) and the time (ten times a second) are due. Hello is first.
class Schedule {
 public:
  void start(std::int64_t now_ticks) { next_second_ticks_ = next_time_ticks_ = now_ticks; }
  /// A Hello is requested as soon as possible.
  void want_hello() { hello_ = true; }

  /// The message due now; the caller sends it at once.
  Due next(std::int64_t now_ticks) {
    if (now_ticks >= next_second_ticks_) {
      skipped_ += (hello_ ? 1U : 0U) + (decoder_ ? 1U : 0U) + (device_ ? 1U : 0U) +
                  3 * keep_up(next_second_ticks_, now_ticks, kTicksPerSecond);
      hello_ = decoder_ = device_ = true;
    }
    if (hello_) return say(hello_, Due::kHello);
    if (now_ticks >= next_time_ticks_) {
      skipped_ += keep_up(next_time_ticks_, now_ticks, kTicksPerSecond / 10);
      return Due::kTime;
    }
    if (decoder_) return say(decoder_, Due::kDecoderCounters);
    if (device_) return say(device_, Due::kDeviceCounters);
    return Due::kNothing;
  }

  /// Messages that were due and not sent in time, because the line was busy.
  std::uint32_t skipped() const { return skipped_; }

 private:
  static Due say(bool& wanted, Due what) {
    wanted = false;
    return what;
  }
  // Moves `next` past now; counts the missed periods.
  static std::uint32_t keep_up(std::int64_t& next, std::int64_t now, std::int64_t period) {
    std::uint32_t missed = 0;
    next += period;
    if (now - next >= kLongestCatchUp) next = now + period;  // the clock jumped: nothing was due in between
    for (; next <= now; next += period) ++missed;
    return missed;
  }
  static constexpr std::int64_t kLongestCatchUp = 100 * kTicksPerSecond;

  std::int64_t next_second_ticks_ = 0;
  std::int64_t next_time_ticks_ = 0;
  std::uint32_t skipped_ = 0;
  bool hello_ = false;
  bool decoder_ = false;
  bool device_ = false;
};

}  // namespace pharos::app
