// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/light_decoder.hpp"

#include <algorithm>

namespace pharos::lighthouse {

// The pulse in registers: nearly all join a group and return before this.
void LightDecoder::handle_long(std::int64_t rise_ticks, std::int32_t width_ticks, std::uint8_t sensor) {
  const Pulse pulse{rise_ticks, width_ticks, sensor};
  while (!grouping_.open(pulse)) {
    close(grouping_.first_to_close());
    if (grouping_.join(pulse)) break;
  }
  refresh_deadline();
}

void LightDecoder::pass_time(std::int64_t now_ticks) {
  while (now_ticks > grouping_.deadline_ticks()) close(grouping_.first_to_close());
  if (now_ticks > collector_.deadline_ticks()) collector_.pass_time(now_ticks, counters_);
  refresh_deadline();
}

void LightDecoder::refresh_deadline() {
  deadline_ticks_ = std::min(grouping_.deadline_ticks(), collector_.deadline_ticks());
}

void LightDecoder::close(FlashGroup& group) {
  const FlashCandidate candidate = candidate_of(group);
  if (candidate.length_ticks < kShortestFlash_ticks) {
    for (std::size_t k = 0; k < group.size(); ++k) collector_.push(group[k], counters_);
  } else {
    const auto flash = tracker_.push(candidate, counters_);
    (flash ? counters_.pulses_in_flashes : counters_.pulses_flash_length) += candidate.sensors;
    if (flash) handle(*flash);
  }
  grouping_.close(group);
}

void LightDecoder::handle(const TrackedFlash& flash) {
  collector_.push(flash, counters_);
  const std::uint8_t station = flash.flash.station;
  const auto bytes = ootx_[station].push(flash.flash.data, flash.follows_last, counters_);
  if (bytes && !payloads_.push({flash.flash.start_ticks, station, *bytes})) ++counters_.outputs_overflow;
}

void LightDecoder::finish() {
  pairing_.end(counters_);
  pass_time(INT64_MAX - 1);
  collector_.finish_all(counters_);
  refresh_deadline();
}

void LightDecoder::count_discarded(const TimeBase::Discarded& discarded) {
  counters_.pulses_late += discarded.late_pulses;
  counters_.pulses_off_time += discarded.off_time_pulses;
  counters_.edges_late += discarded.late_edges;
  counters_.edges_off_time += discarded.off_time_edges;
}

std::optional<Sweep> LightDecoder::taken_sweep() {
  std::optional<Sweep> sweep(collector_.finished());
  collector_.drop_finished();
  return sweep;
}

std::optional<OotxPayload> LightDecoder::taken_ootx() { return payloads_.pop(); }

}  // namespace pharos::lighthouse
