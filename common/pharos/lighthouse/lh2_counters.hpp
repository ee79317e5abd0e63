// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::lighthouse {

// Every counter of the decoder of Lighthouse 2.0, once, as PHAROS_DECODER_COUNTERS. X(name, what it counts)
#define PHAROS_LH2_COUNTERS(X)                                                                     \
  X(edges_in, "changes of the receivers' outputs received")                                        \
  X(edges_bad_sensor, "changes dropped: sensor number above 31")                                   \
  X(edges_off_time, "changes dropped: before the sensor's last one, or of no possible time")       \
  X(edges_overflow, "changes of the data dropped: more than a burst holds")                        \
  X(bursts, "bursts of light")                                                                     \
  X(bursts_short, "bursts dropped: too few changes for 17 bits (noise)")                           \
  X(bursts_long, "bursts dropped: longer than a laser plane stays on a sensor")                    \
  X(bursts_no_clock, "bursts dropped: no clock of 6 Mbit/s in them")                               \
  X(bursts_unknown, "bursts dropped: bits of no station's sequence (noise, two stations at once)") \
  X(beams, "bursts identified: channel and place in its sequence")                                 \
  X(beams_beyond_turn, "beams dropped: a place that no turn of the channel reaches")               \
  X(beams_unconfirmed, "beams dropped: no second one leads to the same sync")                      \
  X(hits, "beams kept as hits")                                                                    \
  X(hits_overflow, "hits dropped: more than a sweep holds")                                        \
  X(sweeps, "sweeps reported")                                                                     \
  X(outputs_overflow, "sweeps or payloads dropped: nobody took them in time")                      \
  X(locks, "times a channel's rotor was found")                                                    \
  X(locks_lost, "times it was lost")                                                               \
  X(slow_bits, "bits of OOTX")                                                                     \
  X(slow_bits_contradicting, "bits of OOTX dropped: beams of one turn disagree")                   \
  X(slow_bits_missed, "turns without a bit of OOTX between two with one")

struct Lh2Counters {
#define PHAROS_X(name, text) std::uint32_t name = 0;
  PHAROS_LH2_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// All bursts by what became of them: equals `bursts` once nothing is held back (after Lh2LightDecoder::flush).
constexpr std::uint32_t bursts_accounted(const Lh2Counters& c) {
  return c.bursts_short + c.bursts_long + c.bursts_no_clock + c.bursts_unknown + c.beams;
}

/// All beams likewise (after Lh2SweepDecoder::flush).
constexpr std::uint32_t beams_accounted(const Lh2Counters& c) {
  return c.beams_beyond_turn + c.beams_unconfirmed + c.hits + c.hits_overflow;
}

/// Calls visit(name, value, what it counts) for every counter.
template <class Visitor>
void for_each_counter(const Lh2Counters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name, text);
  PHAROS_LH2_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::lighthouse
