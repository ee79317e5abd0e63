// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::lighthouse {

// Every counter of the decoder by name, once: the struct, `pharos decode --stats`, the counters on the serial line (in
// this order: append only) and PHAROS_STATUS all come from this list. X(name, what it counts)
//
// They balance (pulses_accounted, edges_accounted): every input is counted somewhere.
#define PHAROS_DECODER_COUNTERS(X)                                                                       \
  X(edges_in, "edges received")                                                                          \
  X(edges_bad_sensor, "edges dropped: sensor number above 31")                                           \
  X(edges_late, "edges dropped: more than 350 us out of order")                                          \
  X(edges_off_time, "edges dropped: stale or future, off the recording's time base")                     \
  X(edges_doubled, "edges dropped: the same level twice (its partner was lost or doubled)")              \
  X(edges_never_ended, "edges dropped: no falling edge within the longest credible pulse")               \
  X(pulses_in, "pulses received or paired from edges")                                                   \
  X(pulses_bad_sensor, "pulses dropped: sensor number above 31")                                         \
  X(pulses_too_long, "pulses dropped: longer than any flash")                                            \
  X(pulses_glitch, "pulses dropped: shorter than any laser hit, or of no or negative length")            \
  X(pulses_late, "pulses dropped: more than 350 us out of order")                                        \
  X(pulses_off_time, "pulses dropped: stale or future, off the recording's time base")                   \
  X(pulses_doubled, "pulses dropped: the same sensor at the same time twice")                            \
  X(time_base_changes, "times the stream's time base was taken anew")                                    \
  X(flashes, "sync flashes recognised")                                                                  \
  X(flashes_missed, "sync flashes expected and not seen")                                                \
  X(flashes_rejected, "flash-like pulse groups that fit no slot")                                        \
  X(flashes_before_lock, "flash-like pulse groups seen while no slot cycle was known")                   \
  X(pulses_in_flashes, "pulses that belong to recognised flashes")                                       \
  X(pulses_flash_length, "flash-length pulses of no recognised flash (no lock yet, hands, reflections)") \
  X(locks, "times lock was found")                                                                       \
  X(locks_lost, "times lock was lost")                                                                   \
  X(hits, "laser hits kept")                                                                             \
  X(hits_no_flash, "hits dropped: no flash of a sweeping station in this slot")                          \
  X(hits_out_of_window, "hits dropped: outside the sweep's window")                                      \
  X(hits_overflow, "hits dropped: more than a sweep holds")                                              \
  X(sweeps, "sweeps reported")                                                                           \
  X(sweeps_dark, "of them of slots whose laser was off: a flash and no hits")                            \
  X(sweeps_empty, "of the others: without a hit")                                                        \
  X(outputs_overflow, "sweeps or payloads dropped: nobody took them in time")                            \
  X(ootx_frames, "OOTX frames with a good CRC")                                                          \
  X(ootx_bad_crc, "OOTX frames dropped: bad CRC")                                                        \
  X(ootx_bad_length, "OOTX frames dropped: impossible length")                                           \
  X(ootx_bad_sync, "OOTX frames dropped: a sync bit was 0 (cut by a new preamble, or a wrong bit)")      \
  X(ootx_restarts, "OOTX frames cut: a flash and its bit were missed")

struct DecoderCounters {
#define PHAROS_X(name, text) std::uint32_t name = 0;
  PHAROS_DECODER_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// All pulses by what became of them: equals pulses_in once nothing is held back any more (after Decoder::flush()).
constexpr std::uint32_t pulses_accounted(const DecoderCounters& c) {
  return c.pulses_bad_sensor + c.pulses_too_long + c.pulses_glitch + c.pulses_late + c.pulses_off_time +
         c.pulses_doubled + c.pulses_in_flashes + c.pulses_flash_length + c.hits + c.hits_no_flash +
         c.hits_out_of_window + c.hits_overflow;
}

/// All edges by what became of them, when the input is edges only: equals edges_in after Decoder::flush().
constexpr std::uint32_t edges_accounted(const DecoderCounters& c) {
  return c.edges_bad_sensor + c.edges_late + c.edges_off_time + c.edges_doubled + c.edges_never_ended + 2 * c.pulses_in;
}

/// Calls visit(name, value, what it counts) for every counter, in wire order.
template <class Visitor>
void for_each_counter(const DecoderCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name, text);
  PHAROS_DECODER_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::lighthouse
