// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "firmware/hal/edge_capture.hpp"
#include "pharos/base/lowest_bit.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::app {

/// Records of the capture block -> edges with 64-bit stamps.
///
/// After a gap it is not known since when an input is lit: the fall of each input that was lit before the record is
/// left out (and counted), so that the decoder never pairs it with a rise from before the gap.
class EdgeStream {
 public:
  /// Sets the present time of the counter. Call it at the start and at least every 40 s, so that the wrap is never
  /// ambiguous.
  void note_time(std::int64_t now_ticks) { last_ticks_ = now_ticks; }

  /// Calls give(edge) for every edge of the record, lowest input first.
  template <class Give>
  void push(const hal::CaptureRecord& record, Give&& give) {
    last_ticks_ += ticks_difference(record.time_ticks, static_cast<std::uint32_t>(last_ticks_));
    if (record.gap) unknown_rise_ = record.levels ^ record.changed;
    for (std::uint32_t left = record.changed; left != 0; left &= left - 1) {
      const auto input = lowest_bit(left);
      const std::uint32_t bit = left & (0 - left);
      if ((unknown_rise_ & bit) != 0) {
        unknown_rise_ &= ~bit;
        ++left_out_;
        continue;
      }
      give(lighthouse::Edge{last_ticks_, input, (record.levels & bit) != 0});
    }
  }

  /// Falls left out because their rise is unknown.
  std::uint32_t edges_left_out() const { return left_out_; }

 private:
  std::int64_t last_ticks_ = 0;
  std::uint32_t unknown_rise_ = 0;  // bit per input: lit since before the last gap
  std::uint32_t left_out_ = 0;
};

}  // namespace pharos::app
