// SPDX-License-Identifier: Apache-2.0
// Faults that were seen in recordings, or that a target can produce: none may cost more than it must, and nothing false
// may come out. Truth is exact, so a wrong station, axis, bit or angle fails in expect_truth.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/lighthouse/decoded.hpp"

namespace pharos::lighthouse {
namespace {

using test::Decoded;
using test::SyntheticLight;

constexpr std::int64_t kSecond = 50'000'000;
constexpr std::int64_t kCounterSpan = std::int64_t{1} << 32;

using Light = std::vector<RawPulse>;

Light joined(Light a, const Light& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Flash-length pulses of a moment that has nothing to do with the rest, as devices send after a restart.
Light burst(std::int64_t at, std::size_t pulses) {
  Light light;
  for (std::size_t i = 0; i < pulses; ++i) {
    const std::int64_t rise = at + static_cast<std::int64_t>(i / 8 * 176'000 + i % 8 * 4);
    light.push_back({rise, rise + 3'700, static_cast<std::uint8_t>(i % 8)});
  }
  return light;
}

class Faults : public ::testing::Test {
 protected:
  const SyntheticLight light_{SyntheticLight::Settings{}};
  Decoded decoded_;

  void expect_truth(std::int64_t slots, std::size_t at_least, std::int64_t offset = 0) {
    decoded_.flush();
    EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, slots, offset), at_least);
    test::expect_balance(decoded_.counters());
  }
  const DecoderCounters& counters() const { return decoded_.counters(); }
};

TEST_F(Faults, StaleFirstPulsesCostNothing) {
  Decoded clean;
  clean.push(light_.slots(0, 60));
  clean.flush();
  for (const std::int64_t seconds : {-37, -14, 14, 37}) {
    for (const std::size_t pulses : {1U, 3U, 4U, 15U}) {
      Decoded stale;
      stale.push(joined(burst(kSecond + seconds * kSecond, pulses), light_.slots(0, 60)));
      stale.flush();
      ASSERT_EQ(stale.sweeps.size(), clean.sweeps.size()) << seconds << " s, " << pulses << " pulses";
      EXPECT_EQ(stale.sweeps.front().flash.start_ticks, clean.sweeps.front().flash.start_ticks);
      test::expect_balance(stale.counters());
    }
  }
}

TEST_F(Faults, StaleFirstPulsesBetweenGoodOnesCostNothing) {
  Light light = light_.slots(0, 60);
  for (std::size_t i = 0; i < 15; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(7 * i);
    light.insert(light.begin() + at, burst(20 * kSecond, 15)[i]);
  }
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_GT(counters().pulses_off_time, 0U);
}

TEST_F(Faults, StaleAndFuturePulsesInTheMiddleCostNothing) {
  for (const std::int64_t at : {-30 * kSecond, kSecond / 2, 3 * kSecond, 40 * kSecond, 200 * kSecond}) {
    for (const std::size_t pulses : {1U, 2U, 5U, 15U}) {
      Decoded decoded;
      decoded.push(light_.slots(0, 30));
      decoded.push(burst(at, pulses));
      decoded.push(light_.slots(30, 60));
      decoded.flush();
      EXPECT_GE(test::expect_truth(decoded.sweeps, light_, 60), 54U) << at << " " << pulses;
      EXPECT_EQ(decoded.counters().pulses_off_time, pulses);
      EXPECT_EQ(decoded.counters().locks_lost, 0U);
      EXPECT_EQ(decoded.decoder.time_offset_ticks(), 0);
      test::expect_balance(decoded.counters());
    }
  }
}

TEST_F(Faults, APulseFromTheNearFutureDelaysNothingForLong) {
  // 18 ms ahead: within what a pause of light explains, so it is believed until four pulses say otherwise.
  decoded_.push(light_.slots(0, 30));
  const std::int64_t ahead = light_.flash(0, 32).start_ticks - 30'000;
  decoded_.push(Light{{ahead, ahead + 500, 0}});
  decoded_.push(light_.slots(30, 60));
  expect_truth(60, 52);
  EXPECT_EQ(counters().locks_lost, 0U);
}

TEST_F(Faults, LatePulsesAreDroppedAndCounted) {
  decoded_.push(light_.slots(0, 30));
  const std::int64_t late = light_.flash(0, 29).start_ticks - 176'000;
  decoded_.push(Light{{late, late + 200, 5}});
  decoded_.push(light_.slots(30, 60));
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_late, 1U);
}

TEST_F(Faults, TheCounterWrapsInTheLight) {
  // What the unwrapper behind a 32-bit source does: nothing to be seen.
  SyntheticLight::Settings settings;
  settings.begin_s = 85.5;
  const SyntheticLight light(settings);
  TickUnwrapper unwrapper;
  for (RawPulse pulse : light.slots(0, 120)) {
    pulse.rise_ticks = unwrapper.unwrap(static_cast<std::uint32_t>(pulse.rise_ticks));
    pulse.fall_ticks = unwrapper.unwrap(static_cast<std::uint32_t>(pulse.fall_ticks));
    decoded_.push(Light{pulse});
  }
  decoded_.flush();
  EXPECT_GE(test::expect_truth(decoded_.sweeps, light, 120), 114U);
}

TEST_F(Faults, TheCounterWrapsInTheDark) {
  // 60 s without light: the nearest step of a 32-bit counter points 25.9 s back. Time must go on 60 s later.
  decoded_.push(light_.slots(0, 60));
  const std::int64_t dark = 60 * kSecond;
  decoded_.push(SyntheticLight::shifted(light_.slots(60, 160), dark - kCounterSpan));
  decoded_.flush();
  EXPECT_EQ(decoded_.decoder.time_offset_ticks(), kCounterSpan);
  std::int64_t last = INT64_MIN;
  for (const Sweep& sweep : decoded_.sweeps) {
    EXPECT_GT(sweep.flash.start_ticks, last);
    last = sweep.flash.start_ticks;
  }
  EXPECT_EQ(last, light_.flash(1, 159).start_ticks + dark);
  // Six slots are lost to the new lock, and none to the time base.
  EXPECT_GE(decoded_.lit(), 54U + 94U);
  test::expect_balance(counters());
}

TEST_F(Faults, ATargetThatStartsAnewNeverTurnsTimeBack) {
  decoded_.push(light_.slots(0, 60));
  decoded_.push(SyntheticLight::shifted(light_.slots(60, 160), -light_.flash(0, 60).start_ticks));
  decoded_.flush();
  EXPECT_GE(decoded_.lit(), 54U + 94U);
  for (std::size_t i = 1; i < decoded_.sweeps.size(); ++i) {
    EXPECT_GT(decoded_.sweeps[i].flash.start_ticks, decoded_.sweeps[i - 1].flash.start_ticks);
  }
  EXPECT_EQ(decoded_.decoder.time_offset_ticks(), kCounterSpan);
}

TEST_F(Faults, ALongDarkCostsOneLock) {
  for (const std::int64_t dark : {kSecond / 10, 2 * kSecond, 30 * kSecond, 100 * kSecond}) {
    Decoded decoded;
    decoded.push(light_.slots(0, 60));
    decoded.push(SyntheticLight::shifted(light_.slots(60, 160), dark));
    decoded.flush();
    EXPECT_GE(decoded.lit(), 54U + 94U) << dark;
    EXPECT_EQ(decoded.counters().pulses_off_time, 0U) << dark;
    for (const Sweep& sweep : decoded.sweeps) {
      EXPECT_EQ(sweep.hits.size(), sweep.flash.skip ? 0U : 4U);
    }
  }
}

TEST_F(Faults, AShortDarkCostsNoLock) {
  // 24 slots without any light: the rotors' own clocks carry over it.
  decoded_.push(light_.slots(0, 60));
  decoded_.push(light_.slots(84, 120));
  expect_truth(120, 54 + 35);
  EXPECT_EQ(counters().locks_lost, 0U);
  EXPECT_EQ(counters().flashes_missed, 48U);
}

TEST_F(Faults, MissedFlashesLoseOnlyTheirOwnSweeps) {
  std::mt19937 random(7);
  std::bernoulli_distribution seen(0.95);
  std::size_t missed_lit = 0;
  const Light light = light_.slots(0, 600, [&](const SyntheticLight::FlashTruth& truth) {
    const bool here = seen(random);
    missed_lit += !here && !truth.skip ? 1U : 0U;
    return here;
  });
  decoded_.push(light);
  expect_truth(600, 600 - missed_lit - 8);
  EXPECT_EQ(counters().locks_lost, 0U);
  EXPECT_GT(counters().flashes_missed, 30U);
  EXPECT_EQ(counters().hits_no_flash + counters().hits_out_of_window + counters().hits, 2400U);
  EXPECT_GE(counters().hits_no_flash, 4 * missed_lit);
}

TEST_F(Faults, TheSecondStationIsTheSecondEvenWhenTheFirstIsHidden) {
  decoded_.push(light_.slots(0, 40));
  decoded_.push(light_.slots(40, 240, [](const auto& truth) { return truth.station == 1; }));
  decoded_.push(light_.slots(240, 280));
  expect_truth(280, 34 + 100 + 40);
}

TEST_F(Faults, StationsKeepTheirNumbersAfterADarkThatOnlyOneSurvives) {
  for (const int survivor : {0, 1}) {
    Decoded decoded;
    decoded.push(light_.slots(0, 400));
    decoded.push(light_.slots(700, 900, [survivor](const auto& truth) { return truth.station == survivor; }));
    decoded.push(light_.slots(900, 1000));
    decoded.flush();
    EXPECT_GE(test::expect_truth(decoded.sweeps, light_, 1000), 394U + 90U + 94U) << "survivor " << survivor;
    EXPECT_EQ(decoded.counters().locks_lost, 2U);  // the dark; then two stations explain more than one
  }
}

TEST_F(Faults, ALoneStationOfTwoIsStationZero) {
  decoded_.push(light_.slots(0, 100, [](const auto& truth) { return truth.station == 1; }));
  decoded_.flush();
  ASSERT_GT(decoded_.lit(), 40U);
  for (const Sweep& sweep : decoded_.sweeps) EXPECT_EQ(sweep.flash.station, 0);
  const std::size_t alone = decoded_.sweeps.size();
  decoded_.push(light_.slots(100, 200));
  decoded_.flush();
  // It keeps its number when the first one appears, which becomes station 1.
  for (std::size_t i = alone; i < decoded_.sweeps.size(); ++i) {
    const Flash& flash = decoded_.sweeps[i].flash;
    const std::int64_t slot = (flash.start_ticks - light_.flash(0, 0).start_ticks) / 416'660;
    const bool first = flash.start_ticks == light_.flash(0, slot).start_ticks;
    EXPECT_EQ(flash.station, first ? 1 : 0);
  }
  EXPECT_GT(decoded_.lit(), 40U + 90U);
}

TEST_F(Faults, SweepsWithoutAnyFlashGiveNothing) {
  decoded_.push(light_.slots(0, 200, [](const auto&) { return false; }));
  decoded_.flush();
  EXPECT_TRUE(decoded_.sweeps.empty());
  EXPECT_EQ(counters().hits_no_flash, 800U);
  test::expect_balance(counters());
}

TEST_F(Faults, HandsThatMakeSyncLengthPulsesOfSweepsChangeNothing) {
  Light light = light_.slots(0, 200);
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> length(2'700, 6'900);
  std::uniform_int_distribution<std::int64_t> after(70'000, 320'000);
  std::bernoulli_distribution often(0.7);
  std::size_t hands = 0;
  for (std::int64_t slot = 0; slot < 200; ++slot) {
    if (!often(random)) continue;
    const std::int64_t rise = light_.flash(0, slot).start_ticks + after(random);
    for (const std::uint8_t sensor : {std::uint8_t{10}, std::uint8_t{11}})
      light.push_back({rise + sensor, rise + length(random), sensor});
    hands += 2;
  }
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(200, 190);
  EXPECT_EQ(counters().locks_lost, 0U);
  EXPECT_GE(counters().pulses_flash_length, hands);
  EXPECT_GT(counters().flashes_rejected, 100U);
}

TEST_F(Faults, StretchedAndMergedFlashesAreRefused) {
  Light light = light_.slots(0, 30);
  for (std::int64_t slot = 30; slot < 34; ++slot) {
    const auto truth = light_.flash(0, slot);
    light.push_back({truth.start_ticks, truth.start_ticks + 7'450, 0});  // longer than any code
    light_.add_flash(light_.flash(1, slot), light);
    light_.add_hits(light_.flash(0, slot), light);
    light_.add_hits(light_.flash(1, slot), light);
  }
  // Both flashes of a slot run together.
  const auto merged = light_.flash(0, 34);
  light.push_back({merged.start_ticks, light_.flash(1, 34).start_ticks + 5'000, 0});
  light = joined(light, light_.slots(35, 80));
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(80, 24 + 2 + 45);
  EXPECT_EQ(counters().pulses_too_long, 1U);
  EXPECT_EQ(counters().flashes_rejected, 4U);
  EXPECT_EQ(counters().locks_lost, 0U);
}

TEST_F(Faults, WeakFlashesArePutBackInTime) {
  // From slot 100 on only a sensor that misses 400 ticks of length sees every eighth flash: 300 ticks (470 arcsec)
  // late.
  Light light = light_.slots(0, 100);
  for (std::int64_t slot = 100; slot < 200; ++slot) {
    for (int station = 0; station < 2; ++station) {
      const auto truth = light_.flash(station, slot);
      light_.add_hits(truth, light);
      if (slot % 8 != 3) {
        light_.add_flash(truth, light);
        continue;
      }
      const std::int64_t rise = truth.start_ticks + 300;
      light.push_back({rise, rise + light_.length(truth) - 400, 21});
    }
  }
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  decoded_.flush();
  // To two ticks (3 arcsec): the rotor's own clock says where in the credible range the flash began.
  EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, 200, 0, 2), 190U);
  std::size_t weak = 0;
  for (const Sweep& sweep : decoded_.sweeps) weak += (sweep.flags & kSweepFlashWeak) != 0 ? 1U : 0U;
  EXPECT_EQ(weak, 2U * 12U);
  EXPECT_EQ(counters().flashes_missed, 0U);
}

TEST_F(Faults, ARestartedStationIsFoundAgain) {
  decoded_.push(light_.slots(0, 60));
  // Rotors come back with another phase, without a pause.
  SyntheticLight::Settings settings = light_.settings();
  settings.begin_s += 60.0 / 120.0 + 0.0031;
  const SyntheticLight restarted(settings);
  decoded_.push(restarted.slots(1, 100));
  decoded_.flush();
  EXPECT_EQ(counters().locks, 2U);
  EXPECT_EQ(counters().locks_lost, 1U);
  std::size_t after = 0;
  for (const Sweep& sweep : decoded_.sweeps) {
    if (sweep.flash.start_ticks < restarted.flash(0, 1).start_ticks) continue;
    after += sweep.flash.skip ? 0U : 1U;
  }
  EXPECT_GE(after, 99U - 6U);
  test::expect_balance(counters());
}

TEST_F(Faults, EveryPulseTwiceIsAsGoodAsOnce) {
  Light light;
  for (const RawPulse& pulse : light_.slots(0, 60)) light.insert(light.end(), 2, pulse);
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_doubled, light.size() / 2);
}

TEST_F(Faults, OverlappingPulsesOfOneSensorCountOnce) {
  Light light = light_.slots(0, 60);
  const RawPulse hit = light[100];
  light.push_back({hit.rise_ticks + 10, hit.fall_ticks + 30, hit.sensor});
  SyntheticLight::sort_by_fall(light);
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_doubled, 1U);
}

TEST_F(Faults, NonsensePulsesAreCountedByCause) {
  decoded_.push(light_.slots(0, 20));
  const std::int64_t now = light_.flash(0, 19).start_ticks;
  decoded_.push(Light{{now, now + 68'266, 1},  // saturated
                      {now, now + 15, 2},      // glitch
                      {now, now, 3},           // nothing
                      {now, now - 100, 4},     // negative
                      {now, now + 100, 32},    // no such sensor
                      {now, now + 100, 255},
                      {INT64_MIN, INT64_MAX, 5},  // nonsense, whose difference overflows
                      {INT64_MAX, INT64_MIN, 6},
                      {INT64_MAX - 200, INT64_MAX, 7}});
  decoded_.push(light_.slots(20, 60));
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_too_long, 1U);
  EXPECT_EQ(counters().pulses_glitch, 5U);
  EXPECT_EQ(counters().pulses_bad_sensor, 2U);
  EXPECT_EQ(counters().pulses_off_time, 1U);
}

TEST_F(Faults, LostAndDoubledEdgesCostOnlyTheirPulses) {
  const Light pulses = light_.slots(0, 400);
  std::vector<Edge> edges;
  for (const RawPulse& pulse : pulses) {
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  std::mt19937 random(11);
  std::uniform_int_distribution<int> fate(0, 999);
  std::vector<Edge> damaged;
  for (const Edge& edge : edges) {
    const int what = fate(random);
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

TEST_F(Faults, StaleAndLateEdgesAreCounted) {
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

TEST_F(Faults, APulseThatNeverEndsBlocksNothing) {
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

TEST_F(Faults, MoreHitsThanASweepHoldsAreCounted) {
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

TEST_F(Faults, HitsOutsideTheWindowAreCounted) {
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

TEST_F(Faults, EmptySweepsAreGivenForTheSmoothersSake) {
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

TEST_F(Faults, GarbageThenCleanLightDecodesWithinTwelveFlashes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Decoded decoded;
    // Half of the time on a decoder that was locked before.
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

TEST_F(Faults, LockQualityTellsOfGaps) {
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
