// SPDX-License-Identifier: Apache-2.0
// Light of Lighthouse 2.0 to places in sequences: bursts, biphase mark code, the search.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "pharos/lighthouse/lh2_burst.hpp"
#include "pharos/lighthouse/lh2_identify.hpp"
#include "support/lh2_light.hpp"

namespace pharos::lighthouse {
namespace {

const Lh2Sequences& lh2_sequences() {
  static const Lh2Sequences kSequences;
  return kSequences;
}

// Channel 6: as in the captures.
const test::Lh2Station& lh2_station() {
  static const test::Lh2Station kStation(0x12BD0, 0x1CF73, 120'000);
  return kStation;
}

std::vector<Lh2Burst> bursts_of(const std::vector<Lh2Edge>& light, Lh2Counters& counters) {
  const auto collector = std::make_unique<Lh2BurstCollector>();
  std::vector<Lh2Burst> bursts;
  for (const Lh2Edge& edge : light) {
    if (const auto burst = collector->push(edge, counters)) bursts.push_back(*burst);
  }
  while (const auto burst = collector->flush(counters)) bursts.push_back(*burst);
  return bursts;
}

// One pass: its only burst.
Lh2Burst burst_of(const test::Lh2Station& from, double sync_ticks, std::size_t place, std::size_t bits,
                  unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<Lh2Edge> light = {{0, 5, false, false}};
  from.pass(sync_ticks, false, place, bits, 5, light, random);
  Lh2Counters counters;
  const std::vector<Lh2Burst> bursts = bursts_of(light, counters);
  EXPECT_EQ(bursts.size(), 1U);
  return bursts.at(0);
}

TEST(Lh2Sequences, AreAllOfFullLengthAndPlacesCountTheirBits) {
  std::mt19937 random(3);
  for (std::size_t sequence = 0; sequence < kLh2Sequences; ++sequence) {
    const std::vector<int> bits = test::lh2_sequence(kLh2Taps[sequence], 40'000);
    for (int trial = 0; trial < 8; ++trial) {
      const std::size_t place = trial == 0 ? 0 : random() % 39'000;
      std::uint32_t window = 0;
      for (std::size_t i = 0; i < kWindowBits; ++i) window = window << 1U | static_cast<std::uint32_t>(bits[place + i]);
      EXPECT_EQ(lh2_sequences().place_of(window, sequence), place) << "sequence " << sequence;
      EXPECT_EQ(window_before(window_after(window, kLh2Taps[sequence]), kLh2Taps[sequence]), window);
    }
    // The state before the sync is the last of 2^17 - 1: the sequence has full length.
    EXPECT_EQ(lh2_sequences().place_of(window_before(1, kLh2Taps[sequence]), sequence), kLh2SequenceLength - 1);
  }
  EXPECT_FALSE(lh2_sequences().place_of(0, 0));
  EXPECT_FALSE(lh2_sequences().place_of(1, kLh2Sequences));
}

TEST(Biphase, ReadsEveryBitAtAnyPhaseOfTheCounter) {
  for (int step = 0; step < 50; ++step) {
    const double sync = 1000.0 + step / 50.0 * 25.0 / 3.0;
    const auto bits = biphase_bits(burst_of(lh2_station(), sync, 38'000, 60));
    ASSERT_TRUE(bits) << step;
    ASSERT_GE(bits->count, 59U);
    // The first bit's time, to 3 ns and half a tick's rounding shared over a hundred changes.
    EXPECT_NEAR(static_cast<double>(bits->start_sixths) / 6.0, sync + 38'000 * 25.0 / 3.0, 0.4) << step;
    for (std::size_t i = 0; i + 1 < 60; ++i) {
      EXPECT_EQ(bits->value(i), lh2_station().sequence[0][38'000 + i] != 0) << step << " bit " << i;
      EXPECT_TRUE(bits->is_clean(i));
    }
  }
}

TEST(Biphase, ALostChangeCostsOnlyItsBits) {
  const Lh2Burst whole = burst_of(lh2_station(), 500.0, 1'234, 50);
  const auto expected = biphase_bits(whole);
  ASSERT_TRUE(expected);
  for (std::size_t lost = 4; lost + 4 < whole.edge_ticks.size(); ++lost) {
    Lh2Burst burst = whole;
    burst.edge_ticks.clear();
    for (std::size_t i = 0; i < whole.edge_ticks.size(); ++i) {
      if (i != lost) burst.edge_ticks.push_back(whole.edge_ticks[i]);
    }
    const auto bits = biphase_bits(burst);
    ASSERT_TRUE(bits);
    int differ = 0;
    for (std::size_t i = 0; i < expected->count; ++i) {
      if (bits->value(i) != expected->value(i) || bits->is_clean(i) != expected->is_clean(i)) ++differ;
    }
    EXPECT_LE(differ, 2) << "change " << lost;
  }
}

TEST(Biphase, RefusesWhatHasNoClock) {
  Lh2Burst burst;
  for (std::uint16_t i = 0; i < 12; ++i) burst.edge_ticks.push_back(static_cast<std::uint16_t>(i * 5));
  EXPECT_FALSE(biphase_bits(burst));  // too short for 17 bits
  burst.edge_ticks.clear();
  // 7/25 of a half bit further each time: every phase alike.
  for (std::uint16_t i = 0; i < 100; ++i) burst.edge_ticks.push_back(static_cast<std::uint16_t>(i * 6));
  EXPECT_FALSE(biphase_bits(burst));
}

TEST(Identify, FindsChannelAndPlaceUnderJitterWrongAndLostBits) {
  test::Lh2Station noisy = lh2_station();
  noisy.jitter_ticks = 0.6;  // 12 ns
  std::mt19937 random(11);
  int found = 0, wrong = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::size_t place = 30'000 + random() % 60'000;
    Lh2Burst burst = burst_of(noisy, 777.3, place, 45, static_cast<unsigned>(random()));
    // One of its changes never came.
    Lh2Burst cut = burst;
    cut.edge_ticks.clear();
    const std::size_t a = random() % burst.edge_ticks.size();
    for (std::size_t i = 0; i < burst.edge_ticks.size(); ++i) {
      if (i != a) cut.edge_ticks.push_back(burst.edge_ticks[i]);
    }
    const auto bits = biphase_bits(cut);
    if (!bits) continue;
    const auto beam = identify(*bits, kAllLh2Channels, lh2_sequences());
    if (!beam) continue;
    const double sync = static_cast<double>(beam->time_sixths) / 6.0 - beam->place * 25.0 / 3.0;
    const bool right = beam->channel == 6 && !beam->slow_bit && std::abs(sync - 777.3) < 1.5;
    ++(right ? found : wrong);
    if (right) {
      EXPECT_NEAR(static_cast<double>(beam->centre_sixths) / 6.0,
                  777.3 + (static_cast<double>(place) + 22.5) * 25.0 / 3.0, 1.0);
    }
  }
  EXPECT_GE(found, kTrials * 97 / 100);
  EXPECT_LE(wrong, kTrials / 100);
}

TEST(Identify, RandomBitsSeldomReachAHighScore) {
  constexpr int kScore = 14;
  std::mt19937 random(12);
  int taken = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Lh2Bits bits;
    bits.count = 50;
    for (std::uint32_t& word : bits.values) word = static_cast<std::uint32_t>(random());
    bits.clean.fill(0xFFFFFFFF);
    if (identify(bits, 1U << 6U, lh2_sequences(), kScore)) ++taken;
  }
  EXPECT_LE(taken, 12);  // 1.84^-14 of 34 windows in two sequences: 1.3 % of 400 are 5
}

TEST(Lh2Bursts, AreCountedWhateverBecomesOfThem) {
  std::mt19937 random(4);
  std::vector<Lh2Edge> light = {{0, 5, false, false}};
  lh2_station().pass(1000.0, false, 40'000, 50, 5, light, random);
  light.push_back({500'000, 5, true, false});  // noise of a receiver: one pulse
  light.push_back({500'048, 5, false, false});
  for (int i = 0; i < 2000; ++i)
    light.push_back({600'000 + 20 * i, 5, i % 2 == 0, true});  // 0.8 ms of some other light
  light.push_back({700'000, 5, false, false});
  light.push_back({690'000, 5, true, false});   // before the last one
  light.push_back({800'000, 99, true, false});  // no such sensor
  Lh2Counters counters;
  EXPECT_EQ(bursts_of(light, counters).size(), 1U);
  EXPECT_EQ(counters.bursts, 3U);
  EXPECT_EQ(counters.bursts_short, 1U);
  EXPECT_EQ(counters.bursts_long, 1U);
  EXPECT_EQ(counters.edges_off_time, 1U);
  EXPECT_EQ(counters.edges_bad_sensor, 1U);
}

}  // namespace
}  // namespace pharos::lighthouse
