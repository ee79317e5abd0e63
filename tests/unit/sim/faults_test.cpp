// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "tests/unit/sim/ootx_reader.hpp"
#include "tests/unit/sim/simulated_light.hpp"

namespace pharos::sim {
namespace {

struct Faulty {
  std::vector<SimulatedPulse> pulses;
  std::vector<InjectedFault> faults;

  std::size_t count(const char* kind) const {
    return static_cast<std::size_t>(std::count_if(faults.begin(), faults.end(),
                                                  [&](const InjectedFault& f) { return !std::strcmp(f.kind, kind); }));
  }
};

Faulty run(const LighthouseScenario& scenario, std::uint64_t seed = 1) {
  LighthouseSimulator simulator(scenario, seed);
  Faulty result;
  result.pulses = all_pulses(simulator);
  result.faults = simulator.faults();
  return result;
}

using Key = std::tuple<int, std::int64_t, std::int64_t>;
std::multiset<Key> keys(const std::vector<SimulatedPulse>& pulses) {
  std::multiset<Key> result;
  for (const SimulatedPulse& p : pulses) result.insert({p.sensor, p.rise_ticks, p.fall_ticks});
  return result;
}

LighthouseScenario ten_seconds() {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.duration_s = 10.0;
  return scenario;
}

TEST(Faults, MissedFlashesAreAsManyAsNotedAndHitsRemain) {
  LighthouseScenario scenario = ten_seconds();
  const std::size_t all = read_flashes(run(scenario).pulses).size();
  scenario.faults.missed_flash_rate = 0.04;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(read_flashes(faulty.pulses).size(), all - faulty.count("missed_flash"));
  EXPECT_NEAR(static_cast<double>(faulty.count("missed_flash")), 48.0, 28.0);
}

TEST(Faults, MissedFlashesMayComeInBurstsOfTheSameShare) {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.duration_s = 200.0;
  scenario.faults.missed_flash_rate = 0.1;
  scenario.faults.missed_flash_burst = 20.0;
  const Faulty faulty = run(scenario);
  const auto missed = static_cast<double>(faulty.count("missed_flash"));
  EXPECT_NEAR(missed, 2400.0, 800.0);
  int bursts = 1;
  for (std::size_t i = 1; i < faulty.faults.size(); ++i) {
    if (faulty.faults[i].time_s - faulty.faults[i - 1].time_s > 0.01) ++bursts;
  }
  EXPECT_NEAR(missed / bursts, 20.0, 6.0);
}

TEST(Faults, MissedPulsesAndHitsAreGoneOneByOne) {
  LighthouseScenario scenario = ten_seconds();
  const std::size_t all = run(scenario).pulses.size();
  scenario.faults.missed_hit_rate = 0.1;
  scenario.faults.missed_flash_pulse_rate = 0.05;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(faulty.pulses.size(), all - faulty.count("missed_hit") - faulty.count("missed_flash_pulse"));
  EXPECT_GT(faulty.count("missed_hit"), 100u);
  EXPECT_GT(faulty.count("missed_flash_pulse"), 50u);
}

TEST(Faults, StretchedFlashesAreLongerOnEverySensorByWhatIsNoted) {
  LighthouseScenario scenario = ten_seconds();
  const std::vector<SeenFlash> clean = read_flashes(run(scenario).pulses);
  scenario.faults.stretched_flash_rate = 0.05;
  const Faulty faulty = run(scenario);
  const std::vector<SeenFlash> flashes = read_flashes(faulty.pulses);
  ASSERT_EQ(flashes.size(), clean.size());
  std::vector<double> stretches;
  for (std::size_t i = 0; i < flashes.size(); ++i) {
    const auto longer = static_cast<double>(flashes[i].length_ticks - clean[i].length_ticks);
    if (longer > 50.0) stretches.push_back(longer);
  }
  ASSERT_EQ(stretches.size(), faulty.count("stretched_flash"));
  ASSERT_GT(stretches.size(), 10u);
  for (std::size_t i = 0; i < stretches.size(); ++i) EXPECT_NEAR(stretches[i], faulty.faults[i].amount, 1.1);
}

TEST(Faults, MergedFlashesReachFromTheFirstRiseToTheSecondFall) {
  LighthouseScenario scenario = noise_free_pair();
  scenario.faults.merged_flash_rate = 0.1;
  const Faulty faulty = run(scenario);
  std::set<std::int64_t> slots;
  for (const SimulatedPulse& pulse : faulty.pulses) {
    const std::int64_t length = pulse.fall_ticks - pulse.rise_ticks;
    if (length < 10'000) continue;
    EXPECT_GT(length, 20'404 + 2000) << "weak sensors see up to 900 ticks less of it";
    EXPECT_LT(length, 20'404 + 7000);
    slots.insert(pulse.rise_ticks / 200'000);
  }
  EXPECT_EQ(slots.size(), faulty.count("merged_flash"));
  EXPECT_GT(slots.size(), 3u);
}

TEST(Faults, ReflectionsComeAsOftenAsTheDirectHitAtTheGivenDistanceAndWidth) {
  LighthouseScenario scenario = ten_seconds();
  for (const double delay : {866.0, -3100.0}) {
    scenario.faults.reflections = {{0, Rotor::kX, {1, 2}, 2.0, 5.0, delay, 0.85}};
    const Faulty faulty = run(scenario);
    std::size_t doubled = 0;
    for (const SeenFlash& flash : read_flashes(faulty.pulses)) {
      for (const auto& [sensor, centres] : flash.hits_ticks) {
        if (centres.size() == 1) continue;
        ASSERT_EQ(centres.size(), 2u);
        EXPECT_FALSE(flash.axis_y());
        EXPECT_TRUE(sensor == 1 || sensor == 2);
        EXPECT_NEAR(centres[1] - centres[0], std::abs(delay), 1.1);
        ++doubled;
      }
    }
    EXPECT_NEAR(static_cast<double>(doubled), 2 * 3 * 60, 4);
    EXPECT_EQ(doubled, faulty.count("reflection"));
  }
}

TEST(Faults, StalePulsesComeFirstSaturatedAndFarOff) {
  LighthouseScenario scenario = noise_free_scenario();
  const std::vector<SimulatedPulse> clean = run(scenario).pulses;
  scenario.faults.stale_pulses = 15;
  scenario.faults.stale_s = 37.0;
  const Faulty faulty = run(scenario);
  ASSERT_EQ(faulty.pulses.size(), clean.size() + 15);
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_NEAR(static_cast<double>(faulty.pulses[i].rise_ticks - clean[0].rise_ticks) * 20e-9, 37.0, 0.1);
    EXPECT_EQ(faulty.pulses[i].fall_ticks - faulty.pulses[i].rise_ticks, 68266);
  }
  EXPECT_EQ(faulty.pulses[15].rise_ticks, clean[0].rise_ticks);
}

TEST(Faults, DisorderKeepsEveryPulseAndMovesNoneByMoreThanAsked) {
  LighthouseScenario scenario = noise_free_scenario();
  const std::vector<SimulatedPulse> clean = run(scenario).pulses;
  scenario.faults.reorder_rate = 0.3;
  scenario.faults.reorder_us = 120.0;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(keys(faulty.pulses), keys(clean));
  std::int64_t newest = 0;
  std::int64_t worst = 0;
  std::size_t disordered = 0;
  for (const SimulatedPulse& pulse : faulty.pulses) {
    newest = std::max(newest, pulse.fall_ticks);
    worst = std::max(worst, newest - pulse.fall_ticks);
    if (pulse.fall_ticks < newest) ++disordered;
  }
  EXPECT_LE(worst, 6000);
  EXPECT_GT(worst, 3000);
  EXPECT_GT(disordered, clean.size() / 20);
}

TEST(Faults, DoubledPulsesFollowTheirOriginals) {
  LighthouseScenario scenario = noise_free_scenario();
  const std::vector<SimulatedPulse> clean = run(scenario).pulses;
  scenario.faults.doubled_rate = 0.1;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(faulty.pulses.size(), clean.size() + faulty.count("doubled"));
  EXPECT_GT(faulty.count("doubled"), clean.size() / 20);
  std::set<Key> distinct;
  for (const SimulatedPulse& p : faulty.pulses) distinct.insert({p.sensor, p.rise_ticks, p.fall_ticks});
  EXPECT_EQ(distinct.size(), clean.size());
}

TEST(Faults, ALostEdgeLosesAPulseOrRunsItIntoTheNext) {
  LighthouseScenario scenario = ten_seconds();
  const std::multiset<Key> clean = keys(run(scenario).pulses);
  scenario.faults.lost_edge_rate = 0.01;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(faulty.pulses.size(), clean.size() - faulty.count("lost_rise") - faulty.count("lost_fall"));
  std::size_t merged = 0;
  for (const Key& key : keys(faulty.pulses)) merged += clean.count(key) == 0 ? 1u : 0u;
  EXPECT_GT(faulty.count("lost_rise"), 30u);
  EXPECT_NEAR(static_cast<double>(merged), static_cast<double>(faulty.count("lost_fall")), 5.0);
}

TEST(Faults, GlitchesAndEndlessPulsesAreAddedAsNoted) {
  LighthouseScenario scenario = ten_seconds();
  const std::size_t clean = run(scenario).pulses.size();
  scenario.faults.glitches_per_s = 30.0;
  scenario.faults.endless_per_s = 2.0;
  const Faulty faulty = run(scenario);
  EXPECT_EQ(faulty.pulses.size(), clean + faulty.count("glitch") + faulty.count("endless"));
  EXPECT_NEAR(static_cast<double>(faulty.count("glitch")), 300.0, 80.0);
  const auto longest = std::max_element(faulty.pulses.begin(), faulty.pulses.end(), [](const auto& a, const auto& b) {
    return a.fall_ticks - a.rise_ticks < b.fall_ticks - b.rise_ticks;
  });
  EXPECT_GT(longest->fall_ticks - longest->rise_ticks, 1'000'000);
}

TEST(Faults, HandsTurnHitsIntoFlashLengthsOnTheSensorsTheyCover) {
  LighthouseScenario scenario = ten_seconds();
  scenario.faults.hands_per_s = 0.5;
  scenario.faults.hand_fraction = 0.5;
  const Faulty faulty = run(scenario);
  ASSERT_GT(faulty.count("hand"), 0u);
  std::set<int> covered;
  for (const InjectedFault& fault : faulty.faults) covered.insert(fault.sensor);
  // A smeared hit is in the middle of a slot, where there is no flash.
  const std::int64_t first_flash = read_flashes(run(ten_seconds()).pulses)[0].rise_ticks;
  std::size_t smeared = 0;
  for (const SimulatedPulse& pulse : faulty.pulses) {
    const std::int64_t length = pulse.fall_ticks - pulse.rise_ticks;
    const double phase = std::fmod(static_cast<double>(pulse.rise_ticks - first_flash) + 5000.0, kTurn_ticks / 2);
    if (length < 2900 || phase < 20'000.0) continue;
    EXPECT_TRUE(covered.count(pulse.sensor) != 0);
    EXPECT_LE(length, 7001);
    ++smeared;
  }
  EXPECT_GT(smeared, 10u);
}

TEST(Faults, ARestartedStationIsDarkForAWhileAndComesBackAtAnotherPhase) {
  LighthouseScenario scenario = ten_seconds();
  scenario.faults.restarts = {{0, 4.0, 2.5}};
  const std::vector<SeenFlash> flashes = read_flashes(run(scenario).pulses);
  std::int64_t gap = 0;
  std::size_t after = 0;
  for (std::size_t i = 1; i < flashes.size(); ++i) {
    if (flashes[i].rise_ticks - flashes[i - 1].rise_ticks > gap) {
      gap = flashes[i].rise_ticks - flashes[i - 1].rise_ticks;
      after = i;
    }
  }
  EXPECT_NEAR(static_cast<double>(gap) * 20e-9, 2.5, 0.03);
  const double slots = static_cast<double>(gap) / (kTurn_ticks / 2);
  EXPECT_GT(std::abs(slots - std::round(slots)), 0.01);
  EXPECT_GT(flashes.size() - after, 400u);
}

TEST(Faults, BlackoutsLetNoLightThrough) {
  LighthouseScenario scenario = ten_seconds();
  scenario.faults.blackouts = {{3.0, 4.0}};
  for (const SimulatedPulse& pulse : run(scenario).pulses) {
    const double time = static_cast<double>(pulse.rise_ticks) * 20e-9 - 1.0;
    EXPECT_TRUE(time < 3.0001 || time > 3.9999);
  }
}

TEST(Faults, CorruptOotxFramesFailTheirChecksum) {
  LighthouseScenario scenario = ten_seconds();
  scenario.duration_s = 30.0;
  const auto frames_in = [](const std::vector<SimulatedPulse>& pulses) {
    std::vector<bool> bits;
    for (const SeenFlash& flash : read_flashes(pulses)) bits.push_back(flash.data());
    return read_ootx(bits).size();
  };
  EXPECT_GE(frames_in(run(scenario).pulses), 9u);
  scenario.faults.ootx_corrupt_rate = 1.0;
  EXPECT_LE(frames_in(run(scenario).pulses), 1u) << "the first frame began before the recording";
}

}  // namespace
}  // namespace pharos::sim
