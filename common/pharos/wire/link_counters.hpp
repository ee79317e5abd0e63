// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::wire {

// Every counter of a FrameDecoder by name, once. X(name, what it counts)
#define PHAROS_LINK_COUNTERS(X)                                          \
  X(bytes, "bytes received")                                             \
  X(frames, "good frames")                                               \
  X(frames_lost, "frames that never came: gaps in the sequence numbers") \
  X(bad_crc, "frames dropped: bad CRC")                                  \
  X(bad_stuffing, "frames dropped: byte stuffing broken")                \
  X(too_short, "frames dropped: too short for header and CRC")           \
  X(too_long, "frames dropped: longer than any frame")                   \
  X(wrong_version, "frames dropped: good CRC, other protocol version")   \
  X(unknown_type, "frames skipped: a type this version does not know")   \
  X(repeated, "frames dropped: came again, or behind later ones")        \
  X(restarts, "sequence numbers that started anew (sender restarted)")   \
  X(bad_payload, "frames dropped: good CRC, payload that means nothing") \
  X(garbage_bytes, "bytes that belonged to no good frame")

struct LinkCounters {
#define PHAROS_X(name, text) std::uint64_t name = 0;
  PHAROS_LINK_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// Calls visit(name, value, what it counts) for every counter.
template <class Visitor>
void for_each_counter(const LinkCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name, text);
  PHAROS_LINK_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

}  // namespace pharos::wire
