// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pharos::tof {

/// The repeatable choice of triples: a linear congruential generator suffices to pick pixels.
class RansacSampler {
 public:
  std::size_t below(std::size_t count) {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<std::size_t>((static_cast<std::uint64_t>(state_) * count) >> 32U);
  }

 private:
  std::uint32_t state_ = 1;
};

}  // namespace pharos::tof
