// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "host/calibrate/stationary_average.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::calibrate::test {
namespace {

constexpr std::array<std::size_t, kMaxStations> kSlots = {0, 1};

RecordingLog flown(double speed_m_s, double rate_deg_s) {
  Session session;
  sim::LighthouseScenario scenario = scenario_of(session);
  scenario.duration_s = 10.0;
  sim::ManoeuvreLimits limits;
  limits.speed_m_s = speed_m_s;
  limits.rate_deg_s = rate_deg_s;
  scenario.trajectory = sim::make_random_manoeuvre(limits, scenario.duration_s, sim::RandomStream(1, "flight"));
  sim::LighthouseSimulator simulator(scenario, 1);
  return record(simulator);
}

// Four sensors on both rotors, all stationary at different angles; `extra` adds a second hit to sensor 0.
RecordingLog resting(double extra_rad) {
  RecordingLog log;
  for (int turn = 0; turn < 120; ++turn) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      LoggedSweep sweep{turn * kTicksPerSecond / 60 + index_of(axis) * kTicksPerSecond / 120, 0, axis, {}};
      for (std::uint8_t sensor = 0; sensor < 4; ++sensor) sweep.hits.push_back({sensor, 1.5 + 0.01 * sensor});
      if (extra_rad != 0.0) sweep.hits.push_back({0, 1.5 + extra_rad});
      log.sweeps.push_back(sweep);
    }
  }
  return log;
}

TEST(StationaryIntervals, AreFoundWhereTheTargetIsStationaryAndNowhereElse) {
  Session session;
  session.poses = 6;
  sim::LighthouseSimulator simulator(scenario_of(session), session.seed);
  const StationarySearch search = find_stationary_intervals(record(simulator).sweeps);
  ASSERT_EQ(search.intervals.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const double begin_s = simulator.start_s() + static_cast<double>(i) * 2.2;
    EXPECT_GT(ticks_to_seconds(search.intervals[i].from_ticks), begin_s);
    EXPECT_LT(ticks_to_seconds(search.intervals[i].to_ticks), begin_s + 2.2);
    EXPECT_GT(ticks_to_seconds(search.intervals[i].to_ticks - search.intervals[i].from_ticks), 1.2);
  }
}

TEST(StationaryIntervals, AreNotFoundInFlightNorWhileCreeping) {
  EXPECT_TRUE(find_stationary_intervals(flown(0.5, 60.0).sweeps).intervals.empty());
  // A flight with turning points: it may seem stationary only where its motion is hidden by the noise.
  for (const StationaryInterval& interval : find_stationary_intervals(flown(0.02, 2.0).sweeps).intervals) {
    EXPECT_LT(ticks_to_seconds(interval.to_ticks - interval.from_ticks), 1.0);
  }
}

TEST(StationaryIntervals, ReflectionsNeitherEndAnIntervalNorVanish) {
  for (const double extra_rad : {0.0, 0.005}) {
    const RecordingLog log = resting(extra_rad);
    const StationarySearch search = find_stationary_intervals(log.sweeps);
    ASSERT_EQ(search.intervals.size(), 1u);
    const StationaryAverage average = average_interval(log, 0, search.intervals.front(), kSlots);
    ASSERT_EQ(average.rotors.size(), 2u);
    EXPECT_EQ(average.rotors.front().bearings.size(), extra_rad == 0.0 ? 4u : 5u);
  }
}

TEST(StationaryIntervals, HaveSigmasFromTheirOwnScatter) {
  Session session;
  session.poses = 8;
  sim::LighthouseScenario scenario = scenario_of(session);
  scenario.noise.narrow_sigma_arcsec = 0.0;
  scenario.noise.sigma_arcsec = 20.0;
  sim::LighthouseSimulator simulator(scenario, session.seed);
  const RecordingLog log = record(simulator);
  std::vector<StationaryAverage> intervals;
  for (const StationaryInterval& interval : find_stationary_intervals(log.sweeps).intervals)
    intervals.push_back(average_interval(log, 0, interval, kSlots));
  assign_sigmas(intervals);
  ASSERT_GE(intervals.size(), 6u);
  for (const StationaryAverage& interval : intervals) {
    for (const RotorView& view : interval.rotors) {
      const double common_arcsec = 20.0 * std::sqrt(0.8717) / std::sqrt(view.sweeps);
      EXPECT_NEAR(view.common_sigma_rad * kArcsecPerRad / common_arcsec, 1.0, 0.2);
      for (const MeanBearing& bearing : view.bearings) {
        const double own_arcsec = 20.0 * std::sqrt(1.0 - 0.8717) / std::sqrt(bearing.sweeps);
        EXPECT_NEAR(bearing.own_sigma_rad * kArcsecPerRad / own_arcsec, 1.0, 0.3);
      }
    }
  }
}

}  // namespace
}  // namespace pharos::calibrate::test
