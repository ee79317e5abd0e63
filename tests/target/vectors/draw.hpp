// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::test {

/// Random numbers for the input, identical on every machine: integers, and reals computed from them by one
/// multiplication. (The arithmetic of the standard's distributions differs between libraries.)
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  /// splitmix64 (Steele, Lea, Flood 2014).
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  std::int64_t integer(std::int64_t minimum, std::int64_t maximum) {
    return minimum + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(maximum - minimum + 1));
  }
  bool one_in(std::int64_t count) { return integer(1, count) == 1; }
  /// In [-1, 1).
  double real() { return static_cast<double>(static_cast<std::int64_t>(bits()) >> 11) * 0x1p-52; }

 private:
  std::uint64_t state_;
};

}  // namespace pharos::test
