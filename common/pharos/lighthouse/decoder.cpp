// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/decoder.hpp"

#include <algorithm>

#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {
namespace {

/// After a pulse that falls this long before the newest stamp, no older one can follow.
constexpr std::int64_t kHold_ticks = TimeBase::kMaxBehind_ticks;

}  // namespace

void Decoder::push(const Edge& edge) {
  ++counters_.edges_in;
  if (edge.sensor >= kMaxSensors) {
    ++counters_.edges_bad_sensor;
    return;
  }
  if (!accept_in_order(event_of(edge))) admit_other(edge);
}

void Decoder::push(const RawPulse& pulse) {
  ++counters_.pulses_in;
  if (pulse.sensor >= kMaxSensors) {
    ++counters_.pulses_bad_sensor;
    return;
  }
  // As unsigned: no overflow for whatever was read from a file.
  const auto width = static_cast<std::int64_t>(static_cast<std::uint64_t>(pulse.fall_ticks) -
                                               static_cast<std::uint64_t>(pulse.rise_ticks));
  if (width > kLongestPulse_ticks) {
    ++counters_.pulses_too_long;
  } else if (width < kShortestPulse_ticks) {
    ++counters_.pulses_glitch;
  } else {
    const LightEvent event{pulse.fall_ticks, static_cast<std::uint16_t>(width), pulse.sensor, LightEvent::Kind::kPulse};
    if (!accept_in_order(event)) admit(event);
  }
}

// Nearly all events are on time and newer than all that are held: those never leave the processor's registers.
inline bool Decoder::accept_in_order(LightEvent event) {
  if (!time_base_.fits_at_once(event) || !order_.append(event)) return false;
  // One that is not the newest is not behind `quiet_until_ticks_`, for the newest was not.
  if (event.stamp_ticks > quiet_until_ticks_) release_until(event.stamp_ticks - kHold_ticks);
  return true;
}

// Same arguments as push(): so it needs no stack before it.
[[gnu::noinline]] void Decoder::admit_other(const Edge& edge) { admit(event_of(edge)); }

void Decoder::admit(LightEvent event) {
  if (!time_base_.fits_at_once(event)) return classify(event);
  sort_in(event);
  if (time_base_.newest_ticks() > quiet_until_ticks_) release_until(time_base_.newest_ticks() - kHold_ticks);
}

void Decoder::classify(LightEvent event) {
  TimeBase::Discarded discarded;
  const std::int64_t newest_before = time_base_.newest_ticks();
  switch (time_base_.classify(event, decoded_ticks(), discarded)) {
    case TimeBase::Verdict::kFits:
      sort_in(event);
      release_until(time_base_.newest_ticks() - kHold_ticks);
      break;
    case TimeBase::Verdict::kHeld:
      break;
    case TimeBase::Verdict::kMoved:
      time_moved(newest_before);
      break;
    case TimeBase::Verdict::kOutOfRange:
      ++(event.kind == LightEvent::Kind::kPulse ? discarded.off_time_pulses : discarded.off_time_edges);
      break;
  }
  count_discarded(discarded);
}

void Decoder::time_moved(std::int64_t newest_before) {
  ++counters_.time_base_changes;
  const std::int64_t newest = time_base_.newest_ticks();
  if (newest < newest_before) {
    // What the old base admitted from the future is off the new one.
    LightEvent dropped;
    while (order_.drop_after(newest + TimeBase::kMaxAhead_ticks, dropped)) {
      ++(dropped.kind == LightEvent::Kind::kPulse ? counters_.pulses_off_time : counters_.edges_off_time);
    }
  }
  std::int64_t oldest = newest;
  for (const LightEvent& event : time_base_.held()) oldest = std::min(oldest, event.stamp_ticks);
  if (newest >= newest_before) {
    release_until(newest_before);
    // A step back may have left some events ahead of its time. They are released now: the buffer holds no two that are
    // minutes apart.
    const std::int64_t left_behind = std::min(oldest, newest - kHold_ticks);
    release(static_cast<std::uint32_t>(std::min(left_behind, newest_before + TimeBase::kMaxAhead_ticks)), 0);
  }
  if (newest_before - newest > TimeBase::kMaxAhead_ticks) order_.restart_at(oldest);
  for (const LightEvent& event : time_base_.held()) sort_in(event);
  time_base_.forget_held();
  release_until(newest - kHold_ticks);
}

void Decoder::sort_in(const LightEvent& event) {
  if (order_.full()) release(order_.oldest_stamp(), ReorderBuffer::kCapacity - 1);
  const bool pulse = event.kind == LightEvent::Kind::kPulse;
  switch (order_.insert(event)) {
    case ReorderBuffer::Verdict::kTaken:
      break;
    case ReorderBuffer::Verdict::kDoubled:
      ++(pulse ? counters_.pulses_doubled : counters_.edges_doubled);
      break;
    case ReorderBuffer::Verdict::kLate:
      ++(pulse ? counters_.pulses_late : counters_.edges_late);
      break;
  }
  refresh_quiet();
}

void Decoder::release_until(std::int64_t stamp_ticks) {
  release(static_cast<std::uint32_t>(stamp_ticks), 0);
  if (stamp_ticks > deadline_ticks_) pass_time(stamp_ticks);
  refresh_quiet();
}

void Decoder::refresh_quiet() {
  quiet_until_ticks_ = deadline_ticks_;
  if (!order_.empty()) quiet_until_ticks_ = std::min(quiet_until_ticks_, order_.oldest_ticks() - 1);
  if (quiet_until_ticks_ <= INT64_MAX - kHold_ticks) quiet_until_ticks_ += kHold_ticks;
}

// Releases all events of `until_stamp` or before, except the last `keep`.
void Decoder::release(std::uint32_t until_stamp, std::size_t keep) {
  while (order_.size() > keep && order_.oldest_is_by(until_stamp)) {
    take(order_.pop());
  }
}

void Decoder::advance(std::int64_t now_ticks) {
  time_base_.advance(now_ticks);
  release_until(time_base_.newest_ticks());
}

void Decoder::flush() {
  TimeBase::Discarded discarded;
  const std::int64_t newest_before = time_base_.newest_ticks();
  if (time_base_.end(discarded) == TimeBase::Verdict::kMoved) time_moved(newest_before);
  count_discarded(discarded);
  release(order_.newest_stamp(), 0);
  finish();
}

}  // namespace pharos::lighthouse
