// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "unit/lighthouse/decoded.hpp"

namespace pharos::lighthouse {

inline constexpr std::int64_t kSecond = 50'000'000;
inline constexpr std::int64_t kCounterSpan = std::int64_t{1} << 32;

using Light = std::vector<RawPulse>;

inline Light joined(Light a, const Light& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Flash-length pulses at an unrelated time, as devices send after a restart.
inline Light burst(std::int64_t at, std::size_t pulses) {
  Light light;
  for (std::size_t i = 0; i < pulses; ++i) {
    const std::int64_t rise = at + static_cast<std::int64_t>(i / 8 * 176'000 + i % 8 * 4);
    light.push_back({rise, rise + 3'700, static_cast<std::uint8_t>(i % 8)});
  }
  return light;
}

/// Decodes synthetic light with exact truth, so that a wrong station, axis, bit or angle fails in expect_truth.
class DecoderFaults : public ::testing::Test {
 protected:
  const test::SyntheticLight light_{test::SyntheticLight::Settings{}};
  test::Decoded decoded_;

  void expect_truth(std::int64_t slots, std::size_t at_least, std::int64_t offset = 0) {
    decoded_.flush();
    EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, slots, offset), at_least);
    test::expect_balance(decoded_.counters());
  }
  const DecoderCounters& counters() const { return decoded_.counters(); }
};

}  // namespace pharos::lighthouse
