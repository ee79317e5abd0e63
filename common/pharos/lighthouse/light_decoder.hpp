// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/ring_buffer.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/edge_pairing.hpp"
#include "pharos/lighthouse/flash_grouping.hpp"
#include "pharos/lighthouse/light_event.hpp"
#include "pharos/lighthouse/ootx_frames.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/slot_tracker.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/lighthouse/sweep_collector.hpp"
#include "pharos/lighthouse/time_base.hpp"

namespace pharos::lighthouse {

/// Events in order of time -> sweeps and OOTX payloads: the decoder without its input stage, which Decoder (input
/// nearly in order) and SortedDecoder (in order) add. Integer arithmetic only.
///
/// Take sweeps and payloads after every push; at most SweepCollector::kHeld sweeps and two payloads are queued. A sweep
/// is output with the first pulse of its station's next flash, or as soon as the clock shows that its window has
/// passed. Lock needs 7 to 12 flashes.
class LightDecoder {
 public:
  /// The oldest sweep in the queue, or null. Valid until drop_sweep(): half a kilobyte need not be copied.
  const Sweep* next_sweep() const { return collector_.has_finished() ? &collector_.finished() : nullptr; }
  void drop_sweep() { collector_.drop_finished(); }
  const OotxPayload* next_ootx() const { return payloads_.empty() ? nullptr : &payloads_.front(); }
  void drop_ootx() { payloads_.drop(); }
  /// The same for a caller that wants copies. Asked after every pulse: that there is none is told without a call.
  std::optional<Sweep> take_sweep() { return collector_.has_finished() ? taken_sweep() : std::nullopt; }
  std::optional<OotxPayload> take_ootx() { return payloads_.empty() ? std::nullopt : taken_ootx(); }
  const DecoderCounters& counters() const { return counters_; }
  LockState lock() const { return tracker_.lock(time_base_.newest_ticks()); }
  std::int64_t time_offset_ticks() const { return time_base_.offset_ticks(); }

 protected:
  LightDecoder() = default;
  ~LightDecoder() = default;

  /// An edge or a pulse on the time base, in order of time.
  void take(const LightEvent& event) {
    if (event.kind == LightEvent::Kind::kRise) return rise(event.sensor, event.stamp_ticks);
    if (event.kind == LightEvent::Kind::kFall) return fall(event.sensor, event.stamp_ticks);
    handle(Pulse{event.stamp_ticks - event.width_ticks, event.width_ticks, event.sensor}, event.stamp_ticks);
  }
  void rise(std::uint8_t sensor, std::int64_t stamp_ticks) { pairing_.rise(sensor, stamp_ticks, counters_); }
  void fall(std::uint8_t sensor, std::int64_t stamp_ticks) {
    const std::int32_t width_ticks = pairing_.fall(sensor, stamp_ticks, counters_);
    if (width_ticks >= 0) handle(Pulse{stamp_ticks - width_ticks, width_ticks, sensor}, stamp_ticks);
  }
  /// No event of `now_ticks` or earlier will follow.
  void pass_time(std::int64_t now_ticks);
  /// End of the input: outputs what is still held back.
  void finish();
  void count_discarded(const TimeBase::Discarded& discarded);
  std::int64_t decoded_ticks() const { return tracker_.last_flash_ticks(); }

  static LightEvent event_of(const Edge& edge) {
    return {edge.stamp_ticks, 0, edge.sensor, edge.rising ? LightEvent::Kind::kRise : LightEvent::Kind::kFall};
  }

  // Small members that every edge uses come first: a load reaches 2 KiB from the object's start.
  DecoderCounters counters_;
  /// Time of the next action without new events: the earliest deadline of grouping and collector.
  std::int64_t deadline_ticks_ = INT64_MAX;
  TimeBase time_base_;

 private:
  std::optional<Sweep> taken_sweep();
  std::optional<OotxPayload> taken_ootx();

  static constexpr std::size_t kHeldPayloads = 2;
  static constexpr std::int64_t kNever = INT64_MIN / 2;
  static constexpr std::array<std::int64_t, kMaxSensors> filled_with_never() {
    std::array<std::int64_t, kMaxSensors> times{};
    times.fill(kNever);
    return times;
  }

  void handle(const Pulse& pulse, std::int64_t fall_ticks) {
    if (pulse.width_ticks < kShortestPulse_ticks) {
      ++counters_.pulses_glitch;
      return;
    }
    if (fall_ticks > deadline_ticks_) pass_time(fall_ticks);
    std::int64_t& last_fall = last_fall_ticks_[pulse.sensor];
    // A sensor cannot see a second pulse before the first has ended; a fall far ahead is from an earlier time base.
    const auto overlap = static_cast<std::uint64_t>(last_fall - pulse.rise_ticks);
    if (overlap - 1 < kLongestPulse_ticks) {
      ++counters_.pulses_doubled;
      return;
    }
    last_fall = fall_ticks;
    if (pulse.width_ticks < kShortestFlashPulse_ticks) {
      collector_.push(pulse, counters_);
    } else if (!grouping_.join(pulse)) {
      handle_long(pulse.rise_ticks, pulse.width_ticks, pulse.sensor);
    }
  }
  void handle_long(std::int64_t rise_ticks, std::int32_t width_ticks, std::uint8_t sensor);
  void refresh_deadline();
  void close(FlashGroup& group);
  void handle(const TrackedFlash& flash);

  FlashGrouping grouping_;
  EdgePairing pairing_;
  std::array<std::int64_t, kMaxSensors> last_fall_ticks_ = filled_with_never();
  SlotTracker tracker_;
  SweepCollector collector_;
  std::array<OotxFrames, kMaxStations> ootx_;
  RingBuffer<OotxPayload, kHeldPayloads> payloads_;
};

}  // namespace pharos::lighthouse
