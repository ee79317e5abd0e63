// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <tuple>
#include <vector>

#include "pharos/lighthouse/decoder.hpp"
#include "support/synthetic_light.hpp"

namespace pharos::test {

/// A decoder with all its results so far.
template <class AnyDecoder>
struct DecodedBy {
  AnyDecoder decoder;
  std::vector<lighthouse::Sweep> sweeps;  // lit and dark
  std::vector<lighthouse::OotxPayload> payloads;

  void take() {
    while (auto sweep = decoder.take_sweep()) sweeps.push_back(*sweep);
    while (auto payload = decoder.take_ootx()) payloads.push_back(*payload);
  }
  void push(const std::vector<lighthouse::RawPulse>& light) {
    for (const auto& pulse : light) {
      decoder.push(pulse);
      take();
    }
  }
  void push(const std::vector<lighthouse::Edge>& edges) {
    for (const auto& edge : edges) {
      decoder.push(edge);
      take();
    }
  }
  void flush() {
    decoder.flush();
    take();
  }
  const lighthouse::DecoderCounters& counters() const { return decoder.counters(); }

  std::size_t lit() const {
    std::size_t count = 0;
    for (const auto& sweep : sweeps) count += sweep.flash.skip ? 0 : 1;
    return count;
  }
};

using Decoded = DecodedBy<lighthouse::Decoder>;

/// Checks every sweep against the light: no false sweep, no wrong bit, hits exact to the tick. `offset_ticks` is the
/// time that the decoder had to add. Returns the number of lit sweeps.
inline std::size_t expect_truth(const std::vector<lighthouse::Sweep>& sweeps, const SyntheticLight& light,
                                std::int64_t slots, std::int64_t offset_ticks = 0, std::int64_t tolerance_ticks = 0) {
  std::map<std::pair<int, std::int64_t>, SyntheticLight::FlashTruth> truths;  // by station and time in half slots
  const auto near = [](std::int64_t start) { return (start + 100'000) / 200'000; };
  for (std::int64_t slot = 0; slot < slots; ++slot) {
    for (int station = 0; station < light.stations(); ++station) {
      const auto truth = light.flash(station, slot);
      truths[{station, near(truth.start_ticks)}] = truth;
    }
  }
  std::size_t lit = 0;
  for (const auto& sweep : sweeps) {
    const auto& flash = sweep.flash;
    const std::int64_t start = flash.start_ticks - offset_ticks;
    const auto found = truths.find({flash.station, near(start)});
    if (found == truths.end()) {
      ADD_FAILURE() << "a sweep of station " << int{flash.station} << " at " << start << " where no flash was";
      continue;
    }
    const auto& truth = found->second;
    EXPECT_NEAR(static_cast<double>(start - truth.start_ticks), 0.0, static_cast<double>(tolerance_ticks));
    EXPECT_EQ(index_of(flash.axis), truth.axis) << "slot " << truth.slot;
    EXPECT_EQ(flash.skip, truth.skip) << "slot " << truth.slot;
    EXPECT_EQ(flash.data, truth.data) << "slot " << truth.slot;
    EXPECT_TRUE(!flash.skip || sweep.hits.empty());
    for (const auto& hit : sweep.hits) {
      EXPECT_NEAR(0.5 * hit.centre_half_ticks + static_cast<double>(start - truth.start_ticks),
                  static_cast<double>(light.centre_after_flash(truth, hit.sensor)), 0.0)
          << "slot " << truth.slot << " sensor " << int{hit.sensor};
    }
    lit += flash.skip ? 0 : 1;
  }
  return lit;
}

inline void expect_balance(const lighthouse::DecoderCounters& counters) {
  EXPECT_EQ(counters.pulses_in, lighthouse::pulses_accounted(counters));
}

}  // namespace pharos::test
