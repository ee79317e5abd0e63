// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/capture_feed.hpp"

#include "pharos/base/ticks.hpp"

namespace pharos::sim {
namespace {

// STATUS of one record in the FIFO, and GAP (firmware/rtl/capture_registers.h, which tools may not include).
constexpr std::uint32_t kOneRecord = 1;
constexpr std::uint32_t kGap = 0x00010000;
constexpr std::uint32_t kEnd = 0xFFFFFFFF;
constexpr std::int64_t kTimeEvery_ticks = kTicksPerSecond / 1000;
constexpr std::int64_t kLongestDark_ticks = 100 * kTicksPerSecond;

}  // namespace

void CaptureFeed::push(const lighthouse::RawPulse& pulse) {
  const bool past = given_until_ && pulse.rise_ticks <= *given_until_;
  if (pulse.sensor >= kMaxSensors || pulse.fall_ticks <= pulse.rise_ticks || past ||
      (dark_since_[pulse.sensor] && pulse.rise_ticks <= *dark_since_[pulse.sensor])) {
    ++left_out_;
    return;
  }
  dark_since_[pulse.sensor] = pulse.fall_ticks;
  edges_.push({pulse.rise_ticks, std::uint32_t{1} << pulse.sensor});
  edges_.push({pulse.fall_ticks, std::uint32_t{1} << pulse.sensor});
}

void CaptureFeed::advance(std::int64_t now_ticks) {
  if (!given_until_) put_time(now_ticks < kTimeEvery_ticks ? 0 : now_ticks - kTimeEvery_ticks);
  while (!edges_.empty() && edges_.top().tick < now_ticks) {
    const std::int64_t tick = edges_.top().tick;
    std::uint32_t changed = 0;
    for (; !edges_.empty() && edges_.top().tick == tick; edges_.pop()) changed ^= edges_.top().bit;
    pass_time(tick);
    put_record(tick, changed);
  }
  pass_time(now_ticks);
  put_time(now_ticks);
  given_until_ = now_ticks;
}

// Readings of the counter up to `tick`; in a very long dark interval only for the last second.
void CaptureFeed::pass_time(std::int64_t tick) {
  if (tick - time_given_ > kLongestDark_ticks) put_time(tick - kTicksPerSecond);
  while (tick - time_given_ > kTimeEvery_ticks) put_time(time_given_ + kTimeEvery_ticks);
}

void CaptureFeed::end() {
  put(kEnd);
  for (int i = 0; i < 3; ++i) put(0);
}

void CaptureFeed::put_record(std::int64_t tick, std::uint32_t changed) {
  levels_ ^= changed;
  put(kOneRecord | (first_record_ ? kGap : 0));
  first_record_ = false;
  put(static_cast<std::uint32_t>(tick));
  put(changed);
  put(levels_);
}

void CaptureFeed::put_time(std::int64_t now_ticks) {
  time_given_ = now_ticks;
  put(0);
  put(static_cast<std::uint32_t>(now_ticks));
  put(static_cast<std::uint32_t>(now_ticks >> 32));
  put(0);  // no edge lost
}

void CaptureFeed::put(std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(word >> shift));
}

}  // namespace pharos::sim
