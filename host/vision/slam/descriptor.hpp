// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace pharos::slam {

/// 256 binary tests of an ORB feature.
struct Descriptor {
  std::array<std::uint64_t, 4> bits{};
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// Hamming distance, 0 to 256.
inline int distance(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t k = 0; k < a.bits.size(); ++k) sum += std::popcount(a.bits[k] ^ b.bits[k]);
  return sum;
}

/// Two views of one point differ by less; ORB-SLAM's limits (Mur-Artal 2015).
inline constexpr int kSamePoint = 50;
inline constexpr int kMaybeSamePoint = 100;

}  // namespace pharos::slam
