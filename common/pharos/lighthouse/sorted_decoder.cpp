// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/sorted_decoder.hpp"

namespace pharos::lighthouse {

[[gnu::noinline]] void SortedDecoder::classify(std::int64_t stamp_ticks, std::uint8_t sensor, bool rising) {
  LightEvent event = event_of({stamp_ticks, sensor, rising});
  TimeBase::Discarded discarded;
  switch (time_base_.classify(event, decoded_ticks(), discarded)) {
    case TimeBase::Verdict::kFits:
      take(event);
      break;
    case TimeBase::Verdict::kHeld:
      break;
    case TimeBase::Verdict::kMoved:
      take_held();
      break;
    case TimeBase::Verdict::kOutOfRange:
      ++discarded.off_time_edges;
      break;
  }
  count_discarded(discarded);
}

void SortedDecoder::take_held() {
  ++counters_.time_base_changes;
  for (const LightEvent& event : time_base_.held()) take(event);
  time_base_.forget_held();
}

void SortedDecoder::flush() {
  TimeBase::Discarded discarded;
  if (time_base_.end(discarded) == TimeBase::Verdict::kMoved) take_held();
  count_discarded(discarded);
  finish();
}

}  // namespace pharos::lighthouse
