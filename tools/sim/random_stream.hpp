// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace pharos::sim {

/// Random numbers for one purpose of one simulation: the same seed and purpose give the same numbers on every machine.
///
/// Each purpose draws from a stream of its own, so that switching on a fault does not change the noise. Generator:
/// xoshiro256** (Blackman and Vigna 2018), seeded by splitmix64; the standard library's distributions are not used
/// because their output depends on the implementation.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose);

  std::uint64_t bits();
  /// In [0, 1).
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Marsaglia's polar method).
  double normal();
  bool chance(double probability) { return probability > 0.0 && uniform() < probability; }
  /// In 0 to count - 1.
  int below(int count) { return static_cast<int>(uniform() * count); }
  /// Number of events of a Poisson process with the given mean.
  int poisson(double mean);

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace pharos::sim
