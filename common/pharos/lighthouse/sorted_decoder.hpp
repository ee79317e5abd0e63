// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/lighthouse/light_decoder.hpp"

namespace pharos::lighthouse {

/// Decoder for edges that come in the order of their stamps, as the capture block gives them: what Decoder makes of
/// the same edges, at two thirds of the work and without a kilobyte of elders that might still come (ReorderBuffer).
///
/// Stamps are 64-bit ticks of 20 ns; they may be stale or future: what is dropped is counted by cause. One that breaks
/// the promise costs the pulses that it belongs to and no more. Time given out never runs backwards (TimeBase).
class SortedDecoder : public LightDecoder {
 public:
  void push(const Edge& edge) {
    ++counters_.edges_in;
    if (edge.sensor >= kMaxSensors) {
      ++counters_.edges_bad_sensor;
      return;
    }
    LightEvent event = event_of(edge);
    if (!time_base_.fits_at_once(event)) return classify(edge.stamp_ticks, edge.sensor, edge.rising);
    if (edge.rising) {
      rise(edge.sensor, event.stamp_ticks);
    } else {
      fall(edge.sensor, event.stamp_ticks);
    }
  }
  /// The caller's clock: everything that ended before `now_ticks` has been pushed. Optional; saves waiting for the next
  /// light. Ignored when it is off the time base.
  void advance(std::int64_t now_ticks) {
    time_base_.advance(now_ticks);
    if (time_base_.newest_ticks() > deadline_ticks_) pass_time(time_base_.newest_ticks());
  }
  /// End of the input: gives out what is still held back, as far as the output queue holds it.
  void flush();

 private:
  // In registers: an edge in memory would be written there for every one that fits.
  void classify(std::int64_t stamp_ticks, std::uint8_t sensor, bool rising);
  void take_held();
};

}  // namespace pharos::lighthouse
