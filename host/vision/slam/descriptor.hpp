// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pharos::slam {

/// 256 binary tests of an ORB feature.
struct Descriptor {
  std::array<std::uint64_t, 4> bits{};
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// Hamming distance, 0 to 256. Bits are counted in parallel in the bytes of a word: without a guaranteed processor
/// instruction, std::popcount is a function call for each word.
inline int distance(const Descriptor& a, const Descriptor& b) {
  constexpr std::uint64_t kOdd = 0x5555555555555555U, kPairs = 0x3333333333333333U, kHalves = 0x0F0F0F0F0F0F0F0FU;
  std::uint64_t bytes = 0;  // each at most 32
  for (std::size_t k = 0; k < a.bits.size(); ++k) {
    std::uint64_t x = a.bits[k] ^ b.bits[k];
    x -= (x >> 1U) & kOdd;
    x = (x & kPairs) + ((x >> 2U) & kPairs);
    bytes += (x + (x >> 4U)) & kHalves;
  }
  // Pairs of bytes, since the sum may be 256.
  constexpr std::uint64_t kBytes = 0x00FF00FF00FF00FFU;
  return static_cast<int>((((bytes & kBytes) + ((bytes >> 8U) & kBytes)) * 0x0001000100010001U) >> 48U);
}

/// Two views of one point differ by less; ORB-SLAM's limits (Mur-Artal 2015).
inline constexpr int kLowDistanceThreshold = 50;
inline constexpr int kHighDistanceThreshold = 100;

}  // namespace pharos::slam
