// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/time_base.hpp"

#include <algorithm>

namespace pharos::lighthouse {
namespace {

constexpr std::size_t kAgreeing = 4;
constexpr std::int64_t kAgreeingSpan_ticks = 1'000'000;   // 20 ms
constexpr std::int64_t kShortStepBack_ticks = 2'500'000;  // 50 ms
/// Stamps beyond are invalid (91 years of ticks); sums of a few of them still fit 64 bits.
constexpr std::int64_t kMaxStamp_ticks = std::int64_t{1} << 57;
/// Only invalid input makes the offset grow so far; it saturates here rather than overflow.
constexpr std::uint32_t kLargestOffsetSpans = std::uint32_t{1} << 28U;

}  // namespace

bool TimeBase::fits(std::int64_t stamp) const {
  const std::int64_t ahead = stamp - raw_newest();
  return started_ && ahead <= kMaxAhead_ticks && ahead >= -kMaxBehind_ticks;
}

bool TimeBase::agrees_with_held(std::int64_t stamp) const {
  const std::int64_t ahead = stamp - held_newest_;
  return ahead <= kMaxAhead_ticks && ahead >= -kMaxBehind_ticks;
}

bool TimeBase::confirmed(std::int64_t decoded_ticks) const {
  if (held_.size() < kAgreeing) return false;
  const std::int64_t step = held_newest_ - raw_newest();
  const bool short_step_back = step < 0 && step > -kShortStepBack_ticks;
  if (!started_ || decoded_ticks == kNothingDecoded || short_step_back) return true;
  return held_.full() || held_newest_ - held_oldest_ >= kAgreeingSpan_ticks;
}

void TimeBase::move_to_held(std::int64_t decoded_ticks) {
  const std::int64_t step = held_newest_ - raw_newest();
  const bool short_step_back = started_ && step < 0 && step > -kShortStepBack_ticks;
  if (decoded_ticks != kNothingDecoded && !short_step_back) {
    const std::int64_t missing = decoded_ticks - (held_oldest_ + offset_ticks());
    if (missing > 0 && offset_counter_spans_ < kLargestOffsetSpans)
      offset_counter_spans_ += static_cast<std::uint32_t>((missing + INT64_C(0xFFFFFFFF)) >> 32U);
  }
  newest_ = held_newest_ + offset_ticks();
  started_ = true;
  for (LightEvent& event : held_) event.stamp_ticks += offset_ticks();
}

void TimeBase::discard_held(Discarded& discarded) {
  for (const LightEvent& event : held_) {
    const std::int64_t behind = raw_newest() - event.stamp_ticks;
    const bool late = behind > 0 && behind < kShortStepBack_ticks;
    const bool pulse = event.kind == LightEvent::Kind::kPulse;
    ++(late ? (pulse ? discarded.late_pulses : discarded.late_edges)
            : (pulse ? discarded.off_time_pulses : discarded.off_time_edges));
  }
  forget_held();
}

TimeBase::Verdict TimeBase::classify(LightEvent& event, std::int64_t decoded_ticks, Discarded& discarded) {
  const std::int64_t stamp = event.stamp_ticks;
  if (stamp > kMaxStamp_ticks || stamp < -kMaxStamp_ticks) return Verdict::kOutOfRange;
  if (fits(stamp)) {
    discard_held(discarded);
    event.stamp_ticks += offset_ticks();
    newest_ = std::max(newest_, event.stamp_ticks);
    return Verdict::kFits;
  }
  if (!held_.empty() && !agrees_with_held(stamp)) discard_held(discarded);
  if (held_.empty()) held_newest_ = held_oldest_ = stamp;
  held_newest_ = std::max(held_newest_, stamp);
  held_oldest_ = std::min(held_oldest_, stamp);
  held_.push_back(event);
  steady_ = false;
  if (!confirmed(decoded_ticks)) return Verdict::kHeld;
  move_to_held(decoded_ticks);
  return Verdict::kMoved;
}

TimeBase::Verdict TimeBase::end(Discarded& discarded) {
  if (held_.empty()) return Verdict::kHeld;
  if (started_) {
    discard_held(discarded);
    return Verdict::kHeld;
  }
  move_to_held(kNothingDecoded);
  return Verdict::kMoved;
}

void TimeBase::advance(std::int64_t now_ticks) {
  LightEvent now{now_ticks, 0, 0, LightEvent::Kind::kPulse};
  fits_at_once(now);
}

}  // namespace pharos::lighthouse
