// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "pharos/lighthouse/lh2_burst.hpp"

namespace pharos::test {

/// A sequence of Lighthouse 2.0 as its public description has it, bit by bit: 17 delays, the taps' parity. Place 0 is
/// the first of sixteen zeros and a one.
inline std::vector<int> lh2_sequence(std::uint32_t taps, std::size_t count) {
  std::deque<int> delays(17, 0);  // the newest in front
  delays.front() = 1;
  std::vector<int> bits(delays.rbegin(), delays.rend());
  while (bits.size() < count) {
    int sum = 0;
    for (std::size_t i = 0; i < 17; ++i) sum += (taps >> i & 1U) != 0 ? delays[i] : 0;
    delays.push_front(sum % 2);
    delays.pop_back();
    bits.push_back(sum % 2);
  }
  return bits;
}

/// Light of one station on sensors that it passes, for tests of the decoder.
struct Lh2Station {
  std::vector<int> sequence[2];  // by the slow bit
  double bit_ticks = 50.0 / 6.0;
  double jitter_ticks = 0.0;  // of each change

  Lh2Station(std::uint32_t taps0, std::uint32_t taps1, std::size_t bits)
      : sequence{lh2_sequence(taps0, bits), lh2_sequence(taps1, bits)} {}

  /// The receiver's changes while light passes for `bits` bits from the bit at `place` on, of a turn whose sync was at
  /// `sync_ticks`; with an envelope over them. Appends to `light`, in order.
  void pass(double sync_ticks, bool slow_bit, std::size_t place, std::size_t bits, std::uint8_t sensor,
            std::vector<lighthouse::Lh2Edge>& light, std::mt19937& random) const {
    std::vector<double> changes;
    for (std::size_t i = 0; i < bits; ++i) {
      const double begin = sync_ticks + bit_ticks * static_cast<double>(place + i);
      changes.push_back(begin);
      if (sequence[slow_bit ? 1 : 0][place + i] != 0) changes.push_back(begin + bit_ticks / 2);
    }
    const auto ticks = [](double time) { return static_cast<std::int64_t>(std::lround(time)); };
    bool data = false;
    std::normal_distribution<double> noise(0.0, 1.0);
    const std::int64_t first = ticks(changes.front());
    light.push_back({first - 4, sensor, data, true});
    std::int64_t last = first - 4;
    for (const double change : changes) {
      data = !data;
      last = std::max(last + 1, ticks(change + jitter_ticks * noise(random)));
      light.push_back({last, sensor, data, true});
    }
    const std::int64_t end = std::max(last + 1, ticks(sync_ticks + bit_ticks * static_cast<double>(place + bits)) + 4);
    if (data) light.push_back({end, sensor, false, true});
    light.push_back({end + 1, sensor, false, false});
  }
};

}  // namespace pharos::test
