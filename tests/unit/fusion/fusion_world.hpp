// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "pharos/fusion/target_estimator.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"

namespace pharos::tests {

/// Sources of the close-range world by index.
enum Source : std::size_t { kLighthouse, kTof, kRing2, kSlam };

/// A world with some of the sources only, everything in order.
inline sim::WorldSettings world_of(std::uint64_t seed, const std::vector<std::size_t>& sources) {
  sim::WorldSettings world = tools::close_range_world(seed);
  std::vector<sim::MeasuredSource> chosen;
  for (const std::size_t s : sources) chosen.push_back(world.sources[s]);
  for (sim::MeasuredSource& source : chosen) source.delay_s = 0.001;
  world.sources = chosen;
  world.duration_s = 10.0;
  return world;
}

inline std::int64_t ns(double time_s) { return std::llround(time_s * 1e9); }

/// Feeds all poses that arrive before `until_s`; `next` is where to go on.
inline void feed(fusion::TargetEstimator& estimator, const sim::MeasuredWorld& world, double until_s,
                 std::size_t& next) {
  for (; next < world.poses.size() && world.poses[next].arrival_s < until_s; ++next) {
    estimator.push(tools::measurement_of(world.poses[next]));
  }
}

}  // namespace pharos::tests
