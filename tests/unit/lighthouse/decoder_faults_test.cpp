// SPDX-License-Identifier: Apache-2.0
// Faults of time, darkness and flashes that were seen in recordings, or that a target can produce: none may lose more
// data than necessary, and there must be no false result.
#include "unit/lighthouse/decoder_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pharos::lighthouse {
namespace {

using test::Decoded;
using test::SyntheticLight;

TEST_F(DecoderFaults, StaleFirstPulsesCostNothing) {
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

TEST_F(DecoderFaults, StaleFirstPulsesBetweenGoodOnesCostNothing) {
  Light light = light_.slots(0, 60);
  for (std::size_t i = 0; i < 15; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(7 * i);
    light.insert(light.begin() + at, burst(20 * kSecond, 15)[i]);
  }
  decoded_.push(light);
  expect_truth(60, 54);
  EXPECT_GT(counters().pulses_off_time, 0U);
}

TEST_F(DecoderFaults, StaleAndFuturePulsesInTheMiddleCostNothing) {
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

TEST_F(DecoderFaults, APulseFromTheNearFutureDelaysNothingForLong) {
  // 18 ms ahead: a pause of light can explain it, so it is accepted until four pulses contradict it.
  decoded_.push(light_.slots(0, 30));
  const std::int64_t ahead = light_.flash(0, 32).start_ticks - 30'000;
  decoded_.push(Light{{ahead, ahead + 500, 0}});
  decoded_.push(light_.slots(30, 60));
  expect_truth(60, 52);
  EXPECT_EQ(counters().locks_lost, 0U);
}

TEST_F(DecoderFaults, LatePulsesAreDroppedAndCounted) {
  decoded_.push(light_.slots(0, 30));
  const std::int64_t late = light_.flash(0, 29).start_ticks - 176'000;
  decoded_.push(Light{{late, late + 200, 5}});
  decoded_.push(light_.slots(30, 60));
  expect_truth(60, 54);
  EXPECT_EQ(counters().pulses_late, 1U);
}

TEST_F(DecoderFaults, TheCounterWrapsInTheLight) {
  // The unwrapper after a 32-bit source handles this: no effect.
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

TEST_F(DecoderFaults, TheCounterWrapsInTheDark) {
  // 60 s without light: the nearest step of a 32-bit counter is 25.9 s backwards. Time must continue 60 s later.
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

TEST_F(DecoderFaults, WhatAStepBackLeftAheadOfTimeDoesNotWaitForALeap) {
  // Pulses are held for reordering while time is corrected by 15 ms backwards, then by 60 s forwards: they keep their
  // time and are processed.
  const auto hits = [](std::int64_t at, int count) {
    std::vector<Edge> edges;
    for (int i = 0; i < count; ++i) {
      edges.push_back({at + 5'000 * i, 0, true});
      edges.push_back({at + 5'000 * i + 200, 0, false});
    }
    return edges;
  };
  decoded_.push(hits(kSecond, 3));
  decoded_.push(hits(kSecond - 750'000, 6));
  decoded_.push(hits(61 * kSecond, 6));
  EXPECT_EQ(counters().time_base_changes, 3U);
  EXPECT_EQ(counters().pulses_in, 3U + 6U + 2U);  // of the last six, four are still held back
  decoded_.flush();
  EXPECT_EQ(counters().pulses_in, 15U);
  EXPECT_EQ(counters().edges_in, edges_accounted(counters()));
}

TEST_F(DecoderFaults, ATargetThatStartsAnewNeverTurnsTimeBack) {
  decoded_.push(light_.slots(0, 60));
  decoded_.push(SyntheticLight::shifted(light_.slots(60, 160), -light_.flash(0, 60).start_ticks));
  decoded_.flush();
  EXPECT_GE(decoded_.lit(), 54U + 94U);
  for (std::size_t i = 1; i < decoded_.sweeps.size(); ++i) {
    EXPECT_GT(decoded_.sweeps[i].flash.start_ticks, decoded_.sweeps[i - 1].flash.start_ticks);
  }
  EXPECT_EQ(decoded_.decoder.time_offset_ticks(), kCounterSpan);
}

TEST_F(DecoderFaults, ALongDarkCostsOneLock) {
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

TEST_F(DecoderFaults, AShortDarkCostsNoLock) {
  // 24 slots without any light: the rotors' clocks bridge it.
  decoded_.push(light_.slots(0, 60));
  decoded_.push(light_.slots(84, 120));
  expect_truth(120, 54 + 35);
  EXPECT_EQ(counters().locks_lost, 0U);
  EXPECT_EQ(counters().flashes_missed, 48U);
}

TEST_F(DecoderFaults, MissedFlashesLoseOnlyTheirOwnSweeps) {
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

TEST_F(DecoderFaults, TheSecondStationIsTheSecondEvenWhenTheFirstIsHidden) {
  decoded_.push(light_.slots(0, 40));
  decoded_.push(light_.slots(40, 240, [](const auto& truth) { return truth.station == 1; }));
  decoded_.push(light_.slots(240, 280));
  expect_truth(280, 34 + 100 + 40);
}

TEST_F(DecoderFaults, StationsKeepTheirNumbersAfterADarkThatOnlyOneSurvives) {
  for (const int survivor : {0, 1}) {
    Decoded decoded;
    decoded.push(light_.slots(0, 400));
    decoded.push(light_.slots(700, 900, [survivor](const auto& truth) { return truth.station == survivor; }));
    decoded.push(light_.slots(900, 1000));
    decoded.flush();
    EXPECT_GE(test::expect_truth(decoded.sweeps, light_, 1000), 394U + 90U + 94U) << "survivor " << survivor;
    EXPECT_EQ(decoded.counters().locks_lost, 2U);  // the darkness; then two stations explain the light better than one
  }
}

TEST_F(DecoderFaults, ALoneStationOfTwoIsStationZero) {
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

TEST_F(DecoderFaults, SweepsWithoutAnyFlashGiveNothing) {
  decoded_.push(light_.slots(0, 200, [](const auto&) { return false; }));
  decoded_.flush();
  EXPECT_TRUE(decoded_.sweeps.empty());
  EXPECT_EQ(counters().hits_no_flash, 800U);
  test::expect_balance(counters());
}

TEST_F(DecoderFaults, HandsThatMakeSyncLengthPulsesOfSweepsChangeNothing) {
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

TEST_F(DecoderFaults, StretchedAndMergedFlashesAreRefused) {
  Light light = light_.slots(0, 30);
  for (std::int64_t slot = 30; slot < 34; ++slot) {
    const auto truth = light_.flash(0, slot);
    light.push_back({truth.start_ticks, truth.start_ticks + 7'450, 0});  // longer than any flash code
    light_.add_flash(light_.flash(1, slot), light);
    light_.add_hits(light_.flash(0, slot), light);
    light_.add_hits(light_.flash(1, slot), light);
  }
  // Both flashes of a slot merge.
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

TEST_F(DecoderFaults, WeakFlashesArePutBackInTime) {
  // From slot 100 on every eighth flash is seen only by a sensor whose pulse is 400 ticks too short: 300 ticks (470
  // arcsec) late.
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
  // To two ticks (3 arcsec): the rotor's own clock gives the start of the flash within the plausible range.
  EXPECT_GE(test::expect_truth(decoded_.sweeps, light_, 200, 0, 2), 190U);
  std::size_t weak = 0;
  for (const Sweep& sweep : decoded_.sweeps) weak += (sweep.flags & kSweepFlashWeak) != 0 ? 1U : 0U;
  EXPECT_EQ(weak, 2U * 12U);
  EXPECT_EQ(counters().flashes_missed, 0U);
}

TEST_F(DecoderFaults, ARestartedStationIsFoundAgain) {
  decoded_.push(light_.slots(0, 60));
  // Rotors continue with another phase, without a pause.
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

}  // namespace
}  // namespace pharos::lighthouse
