// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_fusion.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

#include "pharos/fusion/target_estimator.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kFusionRepeats = 9;
constexpr double kFaultsPerHour = 1e-3;
constexpr double kFusionScale_us = 1e6;

// Another lighthouse station is the fifth source.
sim::WorldSettings world_of_five() {
  sim::WorldSettings world = close_range_world(1);
  sim::MeasuredSource station = world.sources.front();
  station.name += "_2";
  station.T_vehicle_sensor.t.x() += 0.5;
  world.sources.push_back(station);
  return world;
}

struct Costs {
  std::vector<double> in_order_s, late_s;
};

Costs costs_of(const sim::WorldSettings& world) {
  const sim::MeasuredWorld measured = sim::simulate_world(world);
  const fusion::Settings settings = settings_of(world, kFaultsPerHour);
  std::vector<double> least(measured.poses.size(), 1e9);
  std::vector<bool> late(measured.poses.size(), false);
  for (int repeat = 0; repeat < kFusionRepeats; ++repeat) {
    const auto estimator = std::make_unique<fusion::TargetEstimator>(settings);
    for (std::size_t k = 0; k < measured.poses.size(); ++k) {
      const fusion::Measurement measurement = measurement_of(measured.poses[k]);
      fusion::Outcome outcome;
      least[k] = std::min(least[k], seconds_of([&] { outcome = estimator->push(measurement); }));
      late[k] = outcome.late;
    }
  }
  Costs out;
  for (std::size_t k = 0; k < least.size(); ++k) (late[k] ? out.late_s : out.in_order_s).push_back(least[k]);
  return out;
}

void add_rows(const std::string& what, std::vector<double> costs_s, std::vector<BenchRow>& rows) {
  if (costs_s.empty()) return;
  std::sort(costs_s.begin(), costs_s.end());
  const auto count = static_cast<double>(costs_s.size());
  const double mean_s = std::accumulate(costs_s.begin(), costs_s.end(), 0.0) / count;
  const double high_s = costs_s[static_cast<std::size_t>(0.99 * (count - 1.0))];
  rows.push_back({what + ", mean", mean_s * kFusionScale_us, std::nullopt, "us", true});
  rows.push_back({what + ", 99 %", high_s * kFusionScale_us, std::nullopt, "us", true});
}

}  // namespace

std::vector<BenchRow> bench_fusion() {
  const Costs costs = costs_of(world_of_five());
  std::vector<BenchRow> rows;
  add_rows("fusion, a pose in order, five sources", costs.in_order_s, rows);
  add_rows("fusion, a late pose, five sources", costs.late_s, rows);
  return rows;
}

}  // namespace pharos::tools
