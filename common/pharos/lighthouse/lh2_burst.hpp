// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/lh2_counters.hpp"

namespace pharos::lighthouse {

/// The outputs of a light receiver after one of them changed.
struct Lh2Edge {
  std::int64_t time_ticks = 0;  // 20 ns, unwrapped
  std::uint8_t sensor = 0;
  bool data = false;   // the demodulated light
  bool light = false;  // the receiver's envelope says that there is modulated light
};

/// Whether a time can be one (within 45 years): sums of a few of them, in sixths too, stay within 64 bits.
constexpr bool is_possible_time(std::int64_t ticks) {
  constexpr std::int64_t kLargest_ticks = std::int64_t{1} << 56;
  return ticks < kLargest_ticks && ticks > -kLargest_ticks;
}

/// Changes of the data that a burst holds: 128 bits, a sheet that passes in 21 us.
inline constexpr std::size_t kMaxBurstEdges = 192;

/// Light of one pass of a laser plane over one sensor.
struct Lh2Burst {
  std::int64_t start_ticks = 0;  // of its first change
  std::uint8_t sensor = 0;
  StaticVector<std::uint16_t, kMaxBurstEdges> edge_ticks;  // changes of the data after start_ticks, the earliest first
  // Envelope after start_ticks; equal where the receiver showed none.
  std::uint16_t light_begin_ticks = 0;
  std::uint16_t light_end_ticks = 0;

  bool has_envelope() const { return light_end_ticks > light_begin_ticks; }
};

/// Gathers changes of all sensors into bursts: a burst ends when its sensor's outputs rest for 1.2 us without light.
///
/// Changes come in order of time for each sensor; what does not is dropped, until 32 in a row say that the counter
/// itself went back. 13 KiB.
class Lh2BurstCollector {
 public:
  /// Returns the burst of the same sensor that ended before this change.
  std::optional<Lh2Burst> push(const Lh2Edge& edge, Lh2Counters& counters);
  /// A burst that has ended by now, if there is one: call until empty.
  std::optional<Lh2Burst> advance(std::int64_t now_ticks, Lh2Counters& counters);
  /// The end of the input: any burst still open.
  std::optional<Lh2Burst> flush(Lh2Counters& counters);

 private:
  struct Receiver {
    Lh2Burst burst;
    std::int64_t last_ticks = 0;
    std::uint8_t early = 0;  // changes before last_ticks, in a row
    bool open = false;
    bool seen = false;
    bool data = false;
    bool light = false;
    bool too_long = false;
  };

  static bool has_ended(const Receiver& receiver, std::int64_t now_ticks);
  static std::optional<Lh2Burst> close(Receiver& receiver, Lh2Counters& counters);
  static void add(Receiver& receiver, const Lh2Edge& edge, Lh2Counters& counters);

  std::array<Receiver, kMaxSensors> receiver_;
};

}  // namespace pharos::lighthouse
