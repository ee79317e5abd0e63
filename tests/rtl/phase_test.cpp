// SPDX-License-Identifier: Apache-2.0
// Light is not synchronous with the clock: edges at any picosecond, compared with the records of the block.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "firmware/rtl/capture_registers.h"
#include "rtl/capture_rig.hpp"

namespace pharos::rtl {
namespace {

constexpr std::int64_t kPicosecondsPerTick = 20'000;
// A change this near to the clock edge may be sampled as either level: the flip-flop is metastable and settles to
// either. Ten times the worst setup and hold time of the family, so that the case is frequent.
constexpr std::int64_t kAperture = 2'000;

struct PinEdge {
  std::int64_t picoseconds;
  unsigned input;
};

class AnyPhase : public testing::TestWithParam<unsigned> {
 protected:
  // Levels of every input, each held for a little more than a tick at least, like pulses of light.
  std::vector<PinEdge> make_edges(std::size_t per_input, const CaptureRig& rig) {
    // Some 50 ticks to an edge over all inputs: the reader is fast enough, and several edges in one tick are frequent.
    const auto longest_extra = static_cast<std::uint64_t>(100 * kPicosecondsPerTick) * rig.build().inputs;
    std::vector<PinEdge> edges;
    for (unsigned input = 0; input < rig.build().inputs; ++input) {
      std::int64_t time = 10 * kPicosecondsPerTick;
      for (std::size_t i = 0; i < per_input; ++i) {
        time += kPicosecondsPerTick + 2 * kAperture + static_cast<std::int64_t>(random_() % longest_extra);
        edges.push_back({time, input});
      }
    }
    std::ranges::sort(edges, {}, &PinEdge::picoseconds);
    return edges;
  }

  // Runs the clock over the edges; the clock edge that ends tick t is at (t + 1) * 20 ns.
  std::vector<CaptureRecord> play(CaptureRig& rig, const std::vector<PinEdge>& edges) {
    rig.reset();
    rig.enable();
    rig.set_ticks(0);
    std::vector<CaptureRecord> records;
    std::uint32_t true_pins = 0;
    std::size_t next = 0;
    const std::int64_t end = edges.back().picoseconds / kPicosecondsPerTick + 2'000;
    while (static_cast<std::int64_t>(rig.ticks()) < end) {
      const std::int64_t sampled_at = (static_cast<std::int64_t>(rig.ticks()) + 1) * kPicosecondsPerTick;
      std::uint32_t uncertain = 0;
      std::size_t reach = next;
      for (; reach < edges.size() && edges[reach].picoseconds <= sampled_at + kAperture; ++reach) {
        if (edges[reach].picoseconds > sampled_at - kAperture) uncertain |= 1u << edges[reach].input;
      }
      for (; next < edges.size() && edges[next].picoseconds <= sampled_at; ++next) true_pins ^= 1u << edges[next].input;
      rig.set_pins(true_pins ^ (uncertain & static_cast<std::uint32_t>(random_())));
      rig.tick({BusRequest::Kind::kNone, 0, 0});
      if (rig.ticks() % 8 == 0) {
        // Reading takes ticks too: it is done only in ticks without edges, with constant pins.
        const bool quiet = next >= edges.size() || edges[next].picoseconds > sampled_at + 8 * kPicosecondsPerTick;
        if (quiet) {
          rig.set_pins(true_pins);
          if (const auto record = rig.read_record()) records.push_back(*record);
        }
      }
    }
    for (const CaptureRecord& record : rig.drain()) records.push_back(record);
    return records;
  }

  std::mt19937_64 random_{GetParam()};
};

TEST_P(AnyPhase, EveryEdgeIsStampedWithinOneTickOfItsPinOnceAndInOrder) {
  CaptureRig rig;
  const std::size_t per_input = 6'000 / rig.build().inputs;
  const auto edges = make_edges(per_input, rig);
  const auto records = play(rig, edges);
  ASSERT_TRUE(rig.agrees());

  std::vector<std::vector<std::int64_t>> stamped(rig.build().inputs);
  for (const CaptureRecord& record : records) {
    for (unsigned input = 0; input < rig.build().inputs; ++input) {
      if ((record.changed >> input & 1) == 0) continue;
      stamped[input].push_back(static_cast<std::int64_t>(record.stamp) - PHAROS_CAPTURE_LATENCY_TICKS);
      EXPECT_EQ(record.levels >> input & 1, stamped[input].size() % 2) << "levels go up and down in turn";
    }
  }
  const std::uint32_t lost = rig.read(PHAROS_CAPTURE_LOST_OFFSET);
  ASSERT_EQ(lost, 0u);
  std::vector<std::vector<std::int64_t>> truth(rig.build().inputs);
  for (const PinEdge& edge : edges) truth[edge.input].push_back(edge.picoseconds);
  for (unsigned input = 0; input < rig.build().inputs; ++input) {
    ASSERT_EQ(stamped[input].size(), truth[input].size()) << "input " << input;
    for (std::size_t i = 0; i < truth[input].size(); ++i) {
      // The pin changed in the tick of the stamp or, within the aperture, at either end of it.
      const std::int64_t begin = stamped[input][i] * kPicosecondsPerTick;
      EXPECT_GE(truth[input][i], begin - kAperture);
      EXPECT_LE(truth[input][i], begin + kPicosecondsPerTick + kAperture);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyPhase, testing::Values(1u, 2u));

}  // namespace
}  // namespace pharos::rtl
