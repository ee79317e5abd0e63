// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/lighthouse/light_decoder.hpp"
#include "pharos/lighthouse/reorder_buffer.hpp"

namespace pharos::lighthouse {

/// Edges or pulses in, nearly in order; sweeps and OOTX payloads out (LightDecoder).
///
/// Stamps are 64-bit ticks of 20 ns; a 32-bit counter is unwrapped by the caller (base/ticks.hpp). They may be out of
/// order by 200 us, doubled, stale or in the future: what is dropped is counted by cause. Sweeps have the caller's
/// stamps; only where confirmed stamps step back before what was decoded, time_offset_ticks() is added from there on, a
/// multiple of 2^32, so that output times never run backwards (see TimeBase).
///
/// Cost: about 50 ns a pulse on a desktop core; state below 16 KiB.
class Decoder : public LightDecoder {
 public:
  void push(const Edge& edge);
  void push(const RawPulse& pulse);
  /// The caller's clock: everything that ended before `now_ticks` has been pushed. Optional; without it output waits
  /// for the next pulse. Ignored when it is off the time base.
  void advance(std::int64_t now_ticks);
  /// End of the input: outputs what is still held back, as far as the output queue holds it.
  void flush();

 private:
  bool accept_in_order(LightEvent event);
  void admit_other(const Edge& edge);
  void admit(LightEvent event);
  void classify(LightEvent event);
  void time_moved(std::int64_t newest_before);
  void sort_in(const LightEvent& event);
  void release_until(std::int64_t stamp_ticks);
  void release(std::uint32_t until_stamp, std::size_t keep);
  void refresh_quiet();

  /// No event leaves the reorder buffer and no deadline passes until the newest stamp is after this.
  std::int64_t quiet_until_ticks_ = INT64_MIN;
  ReorderBuffer order_;
};

}  // namespace pharos::lighthouse
