// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

/// The list that a counters message follows. Lists only ever grow at their end: a receiver with a shorter list ignores
/// the rest, one with a longer list takes the missing ones as not reported.
enum class CounterGroup : std::uint8_t {
  kDecoder = 0,  // PHAROS_DECODER_COUNTERS of pharos/lighthouse/decoder_counters.hpp
  kDevice = 1,   // PHAROS_DEVICE_COUNTERS below
};

// Counters of the target's own program, in wire order (append only). X(name, what it counts)
#define PHAROS_DEVICE_COUNTERS(X)                                                       \
  X(capture_overflows, "times the capture block had to drop edges")                     \
  X(edges_lost, "edges that the capture block dropped")                                 \
  X(frames_sent, "frames sent to the host")                                             \
  X(frames_skipped, "frames given up: the line was too slow")                           \
  X(commands, "commands obeyed")                                                        \
  X(commands_refused, "commands refused")                                               \
  X(receive_errors, "bytes from the host lost or with a framing error")                 \
  X(busy_permille, "share of the processor's time in use over the last second, 1/1000") \
  X(stack_free_bytes, "stack never touched since start")                                \
  X(poses_skipped, "sweeps that no pose was made of: not calibrated, or solver or line behind")

struct DeviceCounters {
#define PHAROS_X(name, text) std::uint32_t name = 0;
  PHAROS_DEVICE_COUNTERS(PHAROS_X)
#undef PHAROS_X
};

/// Calls visit(name, value, what it counts) for every counter, in wire order.
template <class Visitor>
void for_each_counter(const DeviceCounters& counters, Visitor&& visit) {
#define PHAROS_X(name, text) visit(#name, counters.name, text);
  PHAROS_DEVICE_COUNTERS(PHAROS_X)
#undef PHAROS_X
}

/// Counters of one group, sent once a second.
struct Counters {
  static constexpr MessageType kType = MessageType::kCounters;
  static constexpr std::size_t kMaxValues = 64;
  static constexpr std::size_t kMaxBytes = 10 + 4 * kMaxValues;

  std::int64_t time_ticks = 0;
  CounterGroup group = CounterGroup::kDecoder;  // unknown groups pass: their values are skipped
  StaticVector<std::uint32_t, kMaxValues> values;
};

void write(const Counters& message, ByteWriter& out);
void read(ByteReader& in, Counters& message);

}  // namespace pharos::wire
