// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/fusion/target_estimator.hpp"
#include "tools/sim/measurements/measured_world.hpp"

namespace pharos::tools {

/// What 20 looks a second at the fused state found in one run.
struct RunFigures {
  std::size_t looks = 0;            // from the first valid state on
  std::size_t answered = 0;         // with a valid state
  std::size_t protected_looks = 0;  // with protection levels of position and rotation
  std::size_t position_levels = 0;  // with that of position
  std::size_t outside = 0;          // truth outside of either
  std::size_t wrong_excluded = 0;   // looks in which a right source was excluded
  std::size_t conflict = 0;
  std::size_t fused = 0;
  // Squares, summed over `settled` looks: five seconds after the start, mode fused.
  std::size_t settled = 0;
  double pose_nees = 0.0, rate_nees = 0.0;  // of six each
  double position_m2 = 0.0, rotation_rad2 = 0.0, velocity_m2_s2 = 0.0, rate_rad2_s2 = 0.0;
  double level_position_m = 0.0, level_rotation_rad = 0.0;  // sums over settled looks with a level
  std::size_t settled_levels = 0;
  double largest_ratio = 0.0;              // of the error to the level
  std::optional<double> excluded_after_s;  // the faulty source, since its fault began
  std::optional<double> conflict_after_s;
  std::optional<fusion::FaultKind> reason;
  fusion::FusionCounters counters;
};

/// Runs a world through the estimator in the order of arrival.
RunFigures run_fusion(const sim::WorldSettings& world, const fusion::Settings& settings);

}  // namespace pharos::tools
