// SPDX-License-Identifier: Apache-2.0
// Faults of single edges, pulses and hits, and the decoder's counters.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/lighthouse/decoder_faults.hpp"

namespace pharos::lighthouse {
namespace {

using test::Decoded;
using test::SyntheticLight;

TEST_F(DecoderFaults, EveryPulseTwiceIsAsGoodAsOnce) {
  Light light;
  for (const RawPulse& pulse : light_.slots(0, 60)) light.insert(light.end(), 2, pulse);
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_doubled, light.size() / 2);
}

TEST_F(DecoderFaults, OverlappingPulsesOfOneSensorCountOnce) {
  Light light = light_.slots(0, 60);
  const RawPulse hit = light[100];
  light.push_back({hit.rise_ticks + 10, hit.fall_ticks + 30, hit.sensor});
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_doubled, 1U);
}

TEST_F(DecoderFaults, InvalidPulsesAreCountedByCause) {
  decoded_.push(light_.slots(0, 20));
  const std::int64_t now = light_.flash(0, 19).start_ticks;
  decoded_.push(Light{{now, now + 68'266, 1},  // saturated
                      {now, now + 15, 2},      // glitch
                      {now, now, 3},           // zero length
                      {now, now - 100, 4},     // negative
                      {now, now + 100, 32},    // no such sensor
                      {now, now + 100, 255},
                      {INT64_MIN, INT64_MAX, 5},  // times whose difference overflows
                      {INT64_MAX, INT64_MIN, 6},
                      {INT64_MAX - 200, INT64_MAX, 7}});
  decoded_.push(light_.slots(20, 60));
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_too_long, 1U);
  EXPECT_EQ(counters().pulses_glitch, 5U);
  EXPECT_EQ(counters().pulses_bad_sensor, 2U);
  EXPECT_EQ(counters().pulses_off_time, 1U);
}

TEST_F(DecoderFaults, LostAndDoubledEdgesCostOnlyTheirPulses) {
  const Light pulses = light_.slots(0, 400);
  std::vector<Edge> edges;
  for (const RawPulse& pulse : pulses) {
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  std::mt19937 random(11);
  std::uniform_int_distribution<int> outcome(0, 999);
  std::vector<Edge> damaged;
  for (const Edge& edge : edges) {
    const int what = outcome(random);
    if (what < 10) continue;
    damaged.push_back(edge);
    if (what < 20) damaged.push_back(edge);
    if (what < 22) damaged.push_back({edge.stamp_ticks, 77, true});
  }
  decoded_.push(damaged);
  decoded_.flush();
  const DecoderCounters& c = counters();
  EXPECT_EQ(c.edges_in, damaged.size());
  EXPECT_EQ(c.edges_in, edges_accounted(c));
  EXPECT_GT(c.edges_doubled, 0U);
  EXPECT_GT(c.edges_never_ended, 0U);
  EXPECT_GT(c.edges_bad_sensor, 0U);
  EXPECT_EQ(c.locks_lost, 0U);
  EXPECT_GT(decoded_.lit(), 380U);
  test::expect_balance(c);
}

TEST_F(DecoderFaults, StaleAndLateEdgesAreCounted) {
  std::vector<Edge> edges;
  for (const RawPulse& pulse : light_.slots(0, 60)) {
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  edges.insert(edges.begin() + 300, {{edges[300].stamp_ticks + 9 * kSecond, 2, true},
                                     {edges[300].stamp_ticks + 9 * kSecond + 100, 2, false}});
  edges.insert(edges.begin() + 400, {edges[400].stamp_ticks - 300'000, 2, true});
  decoded_.push(edges);
  decoded_.flush();
  EXPECT_EQ(counters().edges_off_time, 2U);
  EXPECT_EQ(counters().edges_late, 1U);
  EXPECT_EQ(counters().edges_in, edges_accounted(counters()));
  EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, 60), 54U);
}

TEST_F(DecoderFaults, APulseThatNeverEndsBlocksNothing) {
  std::vector<Edge> edges;
  for (const RawPulse& pulse : light_.slots(0, 60)) {
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  const std::int64_t start = edges[200].stamp_ticks;
  edges.insert(edges.begin() + 200, {start, 30, true});
  const auto later =
      std::find_if(edges.begin(), edges.end(), [&](auto& e) { return e.stamp_ticks > start + kSecond / 10; });
  edges.insert(later, {later->stamp_ticks, 30, false});
  decoded_.push(edges);
  decoded_.flush();
  EXPECT_EQ(counters().edges_never_ended, 2U);
  EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, 60), 54U);
}

TEST_F(DecoderFaults, MoreHitsThanASweepHoldsAreCounted) {
  Light light = light_.slots(0, 40);
  const auto lit = light_.flash(0, 30);  // slot 30: the first station sweeps
  ASSERT_FALSE(lit.skip);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t rise = lit.start_ticks + 130'000 + i * 900;
    light.push_back({rise, rise + 60, static_cast<std::uint8_t>(i % 4 + 8)});
  }
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  decoded_.flush();
  EXPECT_EQ(counters().hits_overflow, 104U - kMaxHitsPerSweep);
  test::expect_balance(counters());
}

TEST_F(DecoderFaults, HitsOutsideTheWindowAreCounted) {
  Light light = light_.slots(0, 40);
  const auto lit = light_.flash(0, 30);
  for (const std::int64_t after : {40'000, 340'000}) {
    light.push_back({lit.start_ticks + after, lit.start_ticks + after + 200, 9});
  }
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(40, 34);
  EXPECT_EQ(counters().hits_out_of_window, 2U);
}

TEST_F(DecoderFaults, EmptySweepsAreGivenForTheSmoothersSake) {
  Light light = light_.slots(0, 20);
  for (std::int64_t slot = 20; slot < 60; ++slot) {
    for (int station = 0; station < 2; ++station) light_.add_flash(light_.flash(station, slot), light);
  }
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_EQ(counters().sweeps_empty, 40U);
  EXPECT_EQ(counters().sweeps, decoded_.sweeps.size());
  EXPECT_EQ(counters().sweeps_dark, decoded_.sweeps.size() - decoded_.lit());
}

TEST_F(DecoderFaults, GarbageThenCleanLightDecodesWithinTwelveFlashes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Decoded decoded;
    // In half of the cases the decoder was locked before.
    if (trial % 2 == 0) decoded.push(light_.slots(0, 30));
    Light garbage;
    std::int64_t now = light_.flash(0, 30).start_ticks;
    std::uniform_int_distribution<std::int64_t> step(0, 20'000);
    std::uniform_int_distribution<std::int64_t> width(-10, 9'000);
    for (int i = 0; i < 400; ++i) {
      now += step(random);
      garbage.push_back({now, now + width(random), static_cast<std::uint8_t>(random() % 36)});
    }
    decoded.push(garbage);
    decoded.take();
    // Clean light, at another phase.
    SyntheticLight::Settings settings = light_.settings();
    settings.begin_s = static_cast<double>(now) / 50e6 + 0.002;
    const SyntheticLight clean(settings);
    decoded.push(clean.slots(0, 60));
    decoded.flush();
    std::size_t after = 0;
    for (const Sweep& sweep : decoded.sweeps) {
      if (sweep.flash.start_ticks >= clean.flash(0, 6).start_ticks) after += sweep.flash.skip ? 0U : 1U;
    }
    EXPECT_GE(after, 60U - 6U) << "trial " << trial;
    test::expect_balance(decoded.counters());
  }
}

TEST_F(DecoderFaults, LockQualityShowsGaps) {
  decoded_.push(light_.slots(0, 60));
  EXPECT_TRUE(decoded_.decoder.lock().locked);
  EXPECT_GE(decoded_.decoder.lock().station[0].quality, 15);
  decoded_.push(light_.slots(60, 80, [](const auto& truth) { return truth.station == 1 || truth.slot % 2 == 0; }));
  EXPECT_LE(decoded_.decoder.lock().station[0].quality, 9);
  EXPECT_GE(decoded_.decoder.lock().station[1].quality, 15);
  decoded_.flush();
  for (const Sweep& sweep : decoded_.sweeps) {
    const bool gaps = sweep.flash.station == 0 && sweep.flash.start_ticks > light_.flash(0, 70).start_ticks;
    const bool clean = sweep.flash.station == 1 || sweep.flash.start_ticks < light_.flash(0, 60).start_ticks;
    const bool early = sweep.flash.start_ticks < light_.flash(0, 16).start_ticks;
    const bool poor = (sweep.flags & kSweepLockPoor) != 0;
    if (!early && (gaps || clean)) {
      EXPECT_EQ(poor, gaps);
    }
  }
}

}  // namespace
}  // namespace pharos::lighthouse
