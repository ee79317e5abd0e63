// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/sorted_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/equal_sweeps.hpp"
#include "unit/lighthouse/decoded.hpp"

namespace pharos::lighthouse {
namespace {

using test::SyntheticLight;

constexpr std::int64_t kSlot_ticks = 416'667;

// Two stations with the faults of real light: missing pulses, glitches, reflections, edges whose partner was lost.
std::vector<Edge> faulty_edges(double begin_s, std::int64_t slots, unsigned seed) {
  SyntheticLight::Settings settings;
  settings.begin_s = begin_s;
  std::mt19937 rng(seed);
  const auto one_in = [&](unsigned n) { return rng() % n == 0; };
  std::vector<Edge> edges;
  for (const RawPulse& pulse : SyntheticLight(settings).slots(0, slots)) {
    if (!one_in(60)) edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    if (!one_in(60)) edges.push_back({pulse.fall_ticks, pulse.sensor, false});
    if (one_in(30)) {
      const auto width = static_cast<std::int64_t>(rng() % 900);
      edges.push_back({pulse.fall_ticks + 500, pulse.sensor, true});
      edges.push_back({pulse.fall_ticks + 500 + width, pulse.sensor, false});
    }
    if (one_in(200)) edges.push_back({pulse.rise_ticks, 77, true});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  return edges;
}

void expect_what_decoder_gives(const std::vector<Edge>& edges, std::size_t min_sweeps) {
  test::DecodedBy<SortedDecoder> sorted;
  test::Decoded reference;
  sorted.push(edges);
  sorted.flush();
  reference.push(edges);
  reference.flush();
  ASSERT_GE(reference.sweeps.size(), min_sweeps);
  ASSERT_EQ(sorted.sweeps.size(), reference.sweeps.size());
  for (std::size_t k = 0; k < sorted.sweeps.size(); ++k) test::expect_equal(sorted.sweeps[k], reference.sweeps[k]);
  std::vector<std::uint32_t> expected;
  for_each_counter(reference.counters(), [&](auto, std::uint32_t value, auto) { expected.push_back(value); });
  for_each_counter(sorted.counters(), [&, k = std::size_t{0}](const char* name, std::uint32_t value, auto) mutable {
    EXPECT_EQ(value, expected[k++]) << name;
  });
  EXPECT_EQ(sorted.counters().edges_in, edges_accounted(sorted.counters()));
  test::expect_balance(sorted.counters());
}

TEST(SortedDecoder, GivesWhatDecoderGivesOfFaultyLight) {
  for (unsigned seed = 1; seed <= 8; ++seed) expect_what_decoder_gives(faulty_edges(1.0, 400, seed), 600);
}

TEST(SortedDecoder, FollowsTimeOverADarkAndAStepBackAsDecoderDoes) {
  std::vector<Edge> edges = faulty_edges(1.0, 120, 1);
  for (const double begin_s : {3.0, 90.0, 20.0}) {  // a darkness, a longer one, a target that restarted
    const std::vector<Edge> more = faulty_edges(begin_s, 120, static_cast<unsigned>(begin_s));
    edges.insert(edges.end(), more.begin(), more.end());
  }
  expect_what_decoder_gives(edges, 600);
}

TEST(SortedDecoder, GivesASweepAsSoonAsTheClockSaysThatItsWindowHasPassed) {
  SortedDecoder decoder;
  const auto edges = faulty_edges(1.0, 40, 3);
  for (const Edge& edge : edges) {
    decoder.push(edge);
    while (decoder.next_sweep() != nullptr) decoder.drop_sweep();
  }
  decoder.advance(edges.back().stamp_ticks + 2 * kSlot_ticks);
  EXPECT_NE(decoder.next_sweep(), nullptr);
}

TEST(SortedDecoder, OneEdgeOutOfOrderCostsItsPulseOnly) {
  std::vector<Edge> edges = faulty_edges(1.0, 200, 5);
  test::DecodedBy<SortedDecoder> in_order, out_of_order;
  in_order.push(edges);
  in_order.flush();
  std::swap(edges[edges.size() / 2], edges[edges.size() / 2 + 1]);
  out_of_order.push(edges);
  out_of_order.flush();
  EXPECT_EQ(out_of_order.sweeps.size(), in_order.sweeps.size());
  EXPECT_EQ(out_of_order.counters().edges_in, edges_accounted(out_of_order.counters()));
  EXPECT_LE(in_order.counters().pulses_in - out_of_order.counters().pulses_in, 2U);
  test::expect_balance(out_of_order.counters());
}

}  // namespace
}  // namespace pharos::lighthouse
