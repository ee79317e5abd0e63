// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/ring.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/edge_pairing.hpp"
#include "pharos/lighthouse/event_order.hpp"
#include "pharos/lighthouse/flash_grouping.hpp"
#include "pharos/lighthouse/ootx_frames.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/slot_tracker.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/lighthouse/sweep_collector.hpp"
#include "pharos/lighthouse/time_base.hpp"

namespace pharos::lighthouse {

/// Edges or pulses in, sweeps and OOTX payloads out. Integer arithmetic only.
///
/// Stamps are 64-bit ticks of 20 ns; a 32-bit counter is unwrapped by the caller (base/ticks.hpp). They may be out of
/// order by 200 us, doubled, stale or future: what is dropped is counted by cause. Sweeps come with the caller's
/// stamps; only where confirmed stamps run backwards behind what was decoded is time_offset_ticks() added from there
/// on, a multiple of 2^32, so that time given out never runs backwards (see TimeBase).
///
/// Take sweeps and payloads after every push; at most SweepCollector::kHeld sweeps and two payloads wait.
/// A sweep comes out with the first pulse of its station's next flash, or as soon as advance() says that its window has
/// passed. Lock needs 7 to 12 flashes. Cost: about 50 ns a pulse on a desktop core; state below 16 KiB.
class Decoder {
 public:
  void push(const Edge& edge);
  void push(const RawPulse& pulse);
  /// The caller's clock: everything that ended before `now_ticks` has been pushed. Optional; saves waiting for the next
  /// light. Ignored when it is off the time base.
  void advance(std::int64_t now_ticks);
  /// End of the input: gives out what is still held back, as far as the output queue holds it.
  void flush();

  /// The oldest sweep that waits, null when none does. It stands until drop_sweep(): half a kilobyte need not be
  /// copied.
  const Sweep* next_sweep() const { return collector_.has_finished() ? &collector_.finished() : nullptr; }
  void drop_sweep() { collector_.drop_finished(); }
  const OotxPayload* next_ootx() const { return payloads_.empty() ? nullptr : &payloads_.front(); }
  void drop_ootx() { payloads_.drop(); }
  /// The same for a caller that wants copies.
  std::optional<Sweep> take_sweep();
  std::optional<OotxPayload> take_ootx();
  const DecoderCounters& counters() const { return counters_; }
  LockState lock() const { return tracker_.lock(time_base_.newest_ticks()); }
  std::int64_t time_offset_ticks() const { return time_base_.offset_ticks(); }

 private:
  static constexpr std::size_t kHeldPayloads = 2;
  static constexpr std::int64_t kNever = INT64_MIN / 2;
  static constexpr std::array<std::int64_t, kMaxSensors> filled_with_never() {
    std::array<std::int64_t, kMaxSensors> times{};
    times.fill(kNever);
    return times;
  }

  bool admit_at_once(LightEvent event);
  void admit_other(const Edge& edge);
  void admit(LightEvent event);
  void judge(LightEvent event);
  void count_given_up(const TimeBase::GivenUp& given_up);
  void time_moved(std::int64_t newest_before);
  void sort_in(const LightEvent& event);
  void give_out_until(std::int64_t stamp_ticks);
  void give_out(std::uint32_t until_stamp, std::size_t keep);
  void handle(const Pulse& pulse, std::int64_t fall_ticks);
  void handle_long(const Pulse& pulse);
  void pass_time(std::int64_t now_ticks);
  void refresh_deadline();
  void refresh_quiet();
  void close(FlashGroup& group);
  void handle(const TrackedFlash& flash);
  std::int64_t decoded_ticks() const;

  // Small things that every edge touches first: a load reaches 2 KiB from the object's start.
  DecoderCounters counters_;
  /// When the next thing is to be done but for new light: the earliest deadline of grouping and collector.
  std::int64_t deadline_ticks_ = INT64_MAX;
  /// Nothing leaves the order and no deadline passes until the newest stamp lies behind this.
  std::int64_t quiet_until_ticks_ = INT64_MIN;
  TimeBase time_base_;
  FlashGrouping grouping_;
  EdgePairing pairing_;
  std::array<std::int64_t, kMaxSensors> last_fall_ticks_ = filled_with_never();
  EventOrder order_;
  SlotTracker tracker_;
  SweepCollector collector_;
  std::array<OotxFrames, kMaxStations> ootx_;
  Ring<OotxPayload, kHeldPayloads> payloads_;
};

}  // namespace pharos::lighthouse
