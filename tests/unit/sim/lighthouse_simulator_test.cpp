// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lighthouse_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pharos/base/units.hpp"
#include "tests/unit/sim/ootx_reader.hpp"
#include "tests/unit/sim/simulated_light.hpp"

namespace pharos::sim {
namespace {

constexpr double kTickAngle = kTwoPi / kTurn_ticks;

// Rotor x of lone stations flashes without the axis bit.
std::vector<SeenFlash> simulate(const LighthouseScenario& scenario, std::uint64_t seed = 1) {
  LighthouseSimulator simulator(scenario, seed);
  return read_flashes(all_pulses(simulator));
}

TEST(LighthouseSimulator, HitsASensorStraightAheadAQuarterTurnAfterTheFlash) {
  LighthouseScenario scenario = noise_free_scenario({facing(), {0.0, 0.0, 3.0}});
  scenario.target.clear();
  scenario.target.push_back({5, Vector3::Zero(), Vector3::UnitZ()});
  int hits = 0;
  for (const SeenFlash& flash : simulate(scenario)) {
    for (const auto& [sensor, centres] : flash.hits_ticks) {
      EXPECT_EQ(sensor, 5);
      ASSERT_EQ(centres.size(), 1u);
      EXPECT_NEAR(centres[0], kTurn_ticks / 4, 1.1);
      ++hits;
    }
  }
  EXPECT_NEAR(hits, 120, 2);
}

TEST(LighthouseSimulator, FlashesOfALoneStationAlternateAndNeverSkip) {
  const std::vector<SeenFlash> flashes = simulate(noise_free_scenario());
  ASSERT_GT(flashes.size(), 100u);
  for (std::size_t i = 1; i < flashes.size(); ++i) {
    EXPECT_NE(flashes[i].axis_y(), flashes[i - 1].axis_y());
    EXPECT_FALSE(flashes[i].skip());
    EXPECT_NEAR(static_cast<double>(flashes[i].rise_ticks - flashes[i - 1].rise_ticks), kTurn_ticks / 2, 1.1);
  }
}

TEST(LighthouseSimulator, PairsOfStationsFlashInEverySlotAndOneOfThemSweeps) {
  const std::vector<SeenFlash> flashes = simulate(noise_free_pair());
  ASSERT_GT(flashes.size(), 200u);
  std::vector<bool> first_sweeps;
  for (std::size_t i = 0; i + 1 < flashes.size(); i += 2) {
    const SeenFlash& first = flashes[i];
    const SeenFlash& second = flashes[i + 1];
    EXPECT_NEAR(static_cast<double>(second.rise_ticks - first.rise_ticks), 20404.0, 1.1);
    EXPECT_EQ(first.axis_y(), second.axis_y());
    EXPECT_NE(first.skip(), second.skip());
    first_sweeps.push_back(second.skip());
  }
  for (std::size_t i = 4; i < first_sweeps.size(); ++i) EXPECT_EQ(first_sweeps[i], first_sweeps[i - 4]);
  // Two slots each, X before Y.
  for (std::size_t i = 1; i < first_sweeps.size(); ++i) {
    EXPECT_EQ(first_sweeps[i] == first_sweeps[i - 1], flashes[2 * i].axis_y());
  }
}

TEST(LighthouseSimulator, MeasuresWhatTheModelEquationSaysOfTheTruePose) {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.stations[0].calibration.reset();  // typical
  scenario.errors = ErrorScenario::workshop();
  LighthouseSimulator simulator(scenario, 3);
  int checked = 0;
  for (const SeenFlash& flash : read_flashes(all_pulses(simulator))) {
    for (const auto& [sensor, centres] : flash.hits_ticks) {
      const Vector3 p =
          simulator.truth(0, 1.5) * find_sensor(simulator.true_target(), static_cast<std::uint8_t>(sensor))->position_m;
      const SheetErrors& errors = simulator.stations()[0].true_errors[flash.axis_y() ? 1 : 0];
      EXPECT_NEAR(centres.at(0) * kTickAngle, published_theta_form1(flash.axis_y(), errors, p), 1.2 * kTickAngle);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(LighthouseSimulator, HitsAMovingTargetWhereItIsAtThatInstant) {
  LighthouseScenario scenario = noise_free_scenario();
  ManoeuvreLimits limits;
  limits.speed_m_s = 2.0;
  limits.rate_deg_s = 180.0;
  scenario.duration_s = 5.0;
  scenario.clock = {4'000'000'000, 40.0, 0.1, false};
  scenario.trajectory = make_random_manoeuvre(limits, 5.0, RandomStream(2, "moving"));
  LighthouseSimulator simulator(scenario, 4);
  int checked = 0;
  double greatest_static_error = 0.0;
  for (const SeenFlash& flash : read_flashes(all_pulses(simulator))) {
    if (flash.sensors < 4) continue;
    for (const auto& [sensor, centres] : flash.hits_ticks) {
      const Vector3 p_body = find_sensor(scenario.target, static_cast<std::uint8_t>(sensor))->position_m;
      const double flash_s = static_cast<double>(flash.rise_ticks) * 20e-9;
      const double hit_s = flash_s + centres.at(0) * 20e-9;
      // The counter is up to 40.5 ppm fast: measured turns are longer by that.
      const double period = (simulator.clock().counter_time(1.0) - simulator.clock().counter_time(0.0)) * kTurn_ticks;
      const double theta = centres.at(0) * kTwoPi / period;
      EXPECT_NEAR(theta, published_theta_form1(flash.axis_y(), {}, simulator.truth(0, hit_s) * p_body),
                  1.3 * kTickAngle);
      const double at_flash = published_theta_form1(flash.axis_y(), {}, simulator.truth(0, flash_s) * p_body);
      greatest_static_error = std::max(greatest_static_error, std::abs(theta - at_flash));
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
  EXPECT_GT(greatest_static_error, 50 * kTickAngle) << "the motion must matter, or this test shows nothing";
}

TEST(LighthouseSimulator, NoiseHasTheSpreadAndCorrelationAskedFor) {
  for (const auto& [sigma, rho] : {std::pair{8.8, 0.8717}, std::pair{10.8, 0.97}, std::pair{30.0, 0.0}}) {
    LighthouseScenario scenario = noise_free_scenario({facing(), {0.1, 0.1, 1.5}});
    scenario.duration_s = 60.0;
    scenario.noise.sigma_arcsec = sigma;
    scenario.noise.rho = rho;
    scenario.noise.flash_fraction = 0.6;
    std::array<std::vector<std::array<double, 2>>, 2> turns;  // of sensors 0 and 3, by axis
    std::vector<double> flash_rises;
    for (const SeenFlash& flash : simulate(scenario)) {
      if (flash.hits_ticks.size() < 4) continue;
      turns[flash.axis_y() ? 1 : 0].push_back({flash.hits_ticks.at(0).at(0), flash.hits_ticks.at(3).at(0)});
    }
    for (const auto& axis : turns) {
      ASSERT_GT(axis.size(), 3500u);
      double mean[2] = {0, 0};
      for (const auto& turn : axis) {
        for (std::size_t k : {0u, 1u}) mean[k] += turn[k] / static_cast<double>(axis.size());
      }
      double xx = 0, yy = 0, xy = 0;
      for (const auto& turn : axis) {
        xx += (turn[0] - mean[0]) * (turn[0] - mean[0]);
        yy += (turn[1] - mean[1]) * (turn[1] - mean[1]);
        xy += (turn[0] - mean[0]) * (turn[1] - mean[1]);
      }
      const double deviation = std::sqrt(xx / static_cast<double>(axis.size())) * kTickAngle * kArcsecPerRad;
      // 3600 turns: sigma to 1.2 %, rho to (1 - rho^2) / 60, and a little for the whole ticks of the stamps.
      EXPECT_NEAR(deviation, sigma, 0.05 * sigma);
      EXPECT_NEAR(xy / std::sqrt(xx * yy), rho, 4 * (1 - rho * rho) / 60.0 + 0.01);
    }
  }
}

TEST(LighthouseSimulator, NarrowHitsAreNoisier) {
  LighthouseScenario scenario = noise_free_scenario({facing(), {0.0, 0.0, 9.0}});
  scenario.noise.narrow_sigma_arcsec = 25.0;
  scenario.duration_s = 20.0;
  std::vector<double> x;
  for (const SeenFlash& flash : simulate(scenario)) {
    if (!flash.axis_y() && flash.hits_ticks.count(0) != 0) x.push_back(flash.hits_ticks.at(0).at(0));
  }
  ASSERT_GT(x.size(), 1000u);
  double mean = 0, square = 0;
  for (const double value : x) mean += value / static_cast<double>(x.size());
  for (const double value : x) square += (value - mean) * (value - mean) / static_cast<double>(x.size());
  const double arcsec = std::sqrt(square) * kTickAngle * kArcsecPerRad;
  EXPECT_GT(arcsec, 10.0);
  EXPECT_LT(arcsec, 26.0);
}

TEST(LighthouseSimulator, SendsItsCalibrationInItsFlashes) {
  LighthouseScenario scenario = noise_free_pair();
  scenario.duration_s = 7.0;
  scenario.stations[0].calibration.reset();
  scenario.stations[1].calibration.reset();
  LighthouseSimulator simulator(scenario, 8);
  std::array<std::vector<bool>, 2> bits;
  std::size_t index = 0;
  for (const SeenFlash& flash : read_flashes(all_pulses(simulator))) bits[index++ % 2].push_back(flash.data());
  for (std::size_t station = 0; station < 2; ++station) {
    const std::vector<std::string> payloads = read_ootx(bits[station]);
    ASSERT_GE(payloads.size(), 1u);
    for (const std::string& payload : payloads) {
      EXPECT_EQ(payload, to_hex(announcement_bytes(simulator.stations()[station].announced)));
    }
  }
  EXPECT_NE(simulator.stations()[0].announced.rotor[0].phase_rad, simulator.stations()[1].announced.rotor[0].phase_rad);
}

TEST(LighthouseSimulator, WeakSensorsSeeTheFlashLateByAFixedShareOfWhatTheyLack) {
  LighthouseScenario scenario =
      noise_free_scenario({facing() * rotation_exp(Vector3(0.55, 0.3, 0.0)), {0.0, 0.0, 2.0}});
  LighthouseSimulator simulator(scenario, 2);
  std::map<std::int64_t, std::int64_t> checked;
  const std::vector<SimulatedPulse> pulses = all_pulses(simulator);
  for (const SeenFlash& flash : read_flashes(pulses)) {
    for (const SimulatedPulse& pulse : pulses) {
      if (pulse.fall_ticks - pulse.rise_ticks < 2000 || std::abs(pulse.rise_ticks - flash.rise_ticks) > 3000) continue;
      const auto lacking = static_cast<double>(flash.length_ticks - (pulse.fall_ticks - pulse.rise_ticks));
      const auto late = static_cast<double>(pulse.rise_ticks - flash.rise_ticks);
      EXPECT_GE(late, 0.55 * lacking - 2.0);
      EXPECT_LE(late, 0.95 * lacking + 2.0);
      if (lacking > 100.0) ++checked[pulse.sensor];
    }
  }
  EXPECT_FALSE(checked.empty()) << "some sensor must be weak, or this test shows nothing";
}

TEST(LighthouseSimulator, OnlySensorsBelowTheIncidenceLimitAreLit) {
  const Matrix3 tilted = facing() * rotation_exp(Vector3(0.0, 0.9, 0.0));
  LighthouseSimulator simulator(noise_free_scenario({tilted, {0.0, 0.0, 2.0}}), 1);
  std::set<int> seen;
  for (const SimulatedPulse& pulse : all_pulses(simulator)) seen.insert(pulse.sensor);
  std::set<int> expected;
  for (const SensorPlacement& sensor : frustum()) {
    const Vector3 p = tilted * sensor.position_m + Vector3(0.0, 0.0, 2.0);
    if ((tilted * sensor.normal).dot(-p.normalized()) > 0.5) expected.insert(sensor.sensor);
  }
  EXPECT_EQ(seen, expected);
  EXPECT_GT(expected.size(), 1u);
  EXPECT_LT(expected.size(), 12u);
}

TEST(LighthouseSimulator, AConvexBodyHidesWhatLiesBehindIt) {
  LighthouseScenario scenario = noise_free_scenario({facing(), {0.0, 0.0, 2.0}});
  // A box between the station and the sensors of the +x half: 20 mm to 60 mm in x, above the top plate.
  scenario.body = {{{-1, 0, 0}, -0.02}, {{1, 0, 0}, 0.06},   {{0, 1, 0}, 0.06},
                   {{0, -1, 0}, 0.06},  {{0, 0, -1}, -0.07}, {{0, 0, 1}, 0.10}};
  LighthouseSimulator simulator(scenario, 1);
  std::set<int> seen;
  for (const SimulatedPulse& pulse : all_pulses(simulator)) seen.insert(pulse.sensor);
  EXPECT_TRUE(seen.count(0) != 0 && seen.count(1) != 0) << "x = -25 mm";
  EXPECT_TRUE(seen.count(2) == 0 && seen.count(3) == 0) << "x = +25 mm";
}

TEST(LighthouseSimulator, SameSeedSamePulsesOtherSeedOthers) {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.noise = NoiseScenario{};
  scenario.faults.missed_hit_rate = 0.1;
  const auto pulses_of = [&](std::uint64_t seed) {
    LighthouseSimulator simulator(scenario, seed);
    std::vector<std::int64_t> stamps;
    for (const SimulatedPulse& pulse : all_pulses(simulator)) {
      stamps.insert(stamps.end(), {pulse.sensor, pulse.rise_ticks, pulse.fall_ticks});
    }
    return stamps;
  };
  EXPECT_EQ(pulses_of(1), pulses_of(1));
  EXPECT_NE(pulses_of(1), pulses_of(2));
}

TEST(LighthouseSimulator, PulsesComeInTheOrderOfTheirEnds) {
  LighthouseScenario scenario = noise_free_pair();
  LighthouseSimulator simulator(scenario, 1);
  std::int64_t last = 0;
  for (const SimulatedPulse& pulse : all_pulses(simulator)) {
    EXPECT_GE(pulse.fall_ticks, last);
    last = pulse.fall_ticks;
  }
}

TEST(TargetClock, TrueTimeIsTheInverseOfCounterTime) {
  const TargetClock clock(4'250'000'000, 35.0, -0.01);
  for (const double time : {0.0, 1.0, 37.5, 4000.0}) {
    EXPECT_NEAR(clock.true_time(clock.counter_time(time)), time, 1e-9);
  }
  EXPECT_NEAR(clock.counter_time(1.0) - clock.counter_time(0.0), 1.0 + 35e-6, 1e-8);
}

}  // namespace
}  // namespace pharos::sim
