// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/sorted_decoder.hpp"

namespace pharos::lighthouse {

[[gnu::noinline]] void SortedDecoder::judge(std::int64_t stamp_ticks, std::uint8_t sensor, bool rising) {
  LightEvent event = event_of({stamp_ticks, sensor, rising});
  TimeBase::GivenUp given_up;
  switch (time_base_.judge(event, decoded_ticks(), given_up)) {
    case TimeBase::Verdict::kFits:
      take(event);
      break;
    case TimeBase::Verdict::kHeld:
      break;
    case TimeBase::Verdict::kMoved:
      take_held();
      break;
    case TimeBase::Verdict::kAbsurd:
      ++given_up.off_time_edges;
      break;
  }
  count_given_up(given_up);
}

void SortedDecoder::take_held() {
  ++counters_.time_base_changes;
  for (const LightEvent& event : time_base_.held()) take(event);
  time_base_.forget_held();
}

void SortedDecoder::flush() {
  TimeBase::GivenUp given_up;
  if (time_base_.end(given_up) == TimeBase::Verdict::kMoved) take_held();
  count_given_up(given_up);
  finish();
}

}  // namespace pharos::lighthouse
