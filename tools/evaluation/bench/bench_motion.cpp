// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_motion.hpp"

#include <algorithm>
#include <memory>

#include "pharos/lighthouse/decoder.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kMotionRepeats = 9;
constexpr double kFlight_s = 20.0;

// The paper's manoeuvre with one station, or with two stations 2 m apart that both see the target.
std::vector<lighthouse::Sweep> flown_sweeps(const Target& target, int stations) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = kFlight_s;
  scenario.target = target;
  scenario.stations.resize(static_cast<std::size_t>(stations));
  if (stations == 2) {
    scenario.stations[0].mode = sim::StationMode::kB;
    scenario.stations[1].mode = sim::StationMode::kC;
    scenario.stations[1].id = 0xC33B4DE1u;
    scenario.stations[1].pose.t = {2.0, 0.0, 0.0};
    scenario.stations[1].pose.R = rotation_exp(Vector3(0.0, -0.5, 0.0));
  }
  scenario.trajectory = sim::make_random_manoeuvre({}, kFlight_s, sim::RandomStream(1, "bench motion"));
  sim::LighthouseSimulator simulator(scenario, 1);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  std::vector<lighthouse::Sweep> sweeps;
  while (const auto pulse = simulator.next()) {
    decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    while (decoder->take_ootx()) {
    }
    while (const auto sweep = decoder->take_sweep()) sweeps.push_back(*sweep);
  }
  return sweeps;
}

BenchRow cost_of_a_hit(const std::string& what, const Target& target, int stations) {
  const std::vector<lighthouse::Sweep> sweeps = flown_sweeps(target, stations);
  std::size_t hits = 0;
  for (const lighthouse::Sweep& sweep : sweeps) hits += sweep.hits.size();
  double best_s = 1e9;
  for (int k = 0; k < kMotionRepeats; ++k) {
    const auto tracker = std::make_unique<motion::MotionTracker>(target, motion::MotionOptions{});
    for (int s = 0; s < stations; ++s) tracker->set_calibration(static_cast<std::uint8_t>(s), {});
    best_s = std::min(best_s, seconds_of([&] {
                        for (const lighthouse::Sweep& sweep : sweeps) tracker->push(sweep);
                      }));
  }
  constexpr double kMicroseconds = 1e6;
  return {what, best_s * kMicroseconds / static_cast<double>(hits), std::nullopt, "us", true};
}

}  // namespace

std::vector<BenchRow> bench_motion() {
  const Target target = test::frustum_target();
  return {cost_of_a_hit("motion-aware step, a hit, one station", target, 1),
          cost_of_a_hit("motion-aware step, a hit, two stations and both fused", target, 2)};
}

}  // namespace pharos::tools
