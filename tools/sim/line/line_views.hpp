// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tools/sim/line/line_scenario.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// Where the sun stands: between the line of sight and the panel's normal, somewhere near.
Vector3 sun_for(const LineView& view, RandomStream& random);

/// Attitudes drawn at random: line of sight, axis and roll.
struct RandomLineViews {
  int count = 50;
  double range_m = 100.0;
  double least_elevation_rad = 0.35;
  double most_elevation_rad = 1.3;
  double least_from_sight_rad = 0.52;  ///< between axis and line of sight
  double most_roll_rad = 0.8;
};
std::vector<LineView> random_views(const RandomLineViews& limits, RandomStream random);

/// A pass over the station on a circular orbit, images evenly spaced about the culmination.
struct LinePass {
  double altitude_m = 450e3;
  double side_rad = 0.02;    ///< central angle between station and orbit's plane at culmination
  double heading_rad = 0.5;  ///< of flight there, from north to east
  int images = 100;
  double spacing_s = 2.0;
  double start_s = 0.0;  ///< time of the first image
  /// Body axes: in I (E at the pass' middle), or in O (x flight, y against the orbit's normal, z nadir).
  enum class Law { kInertial, kNadir, kSpin } law = Law::kInertial;
  Vector3 axis{1.0, 0.0, 0.0};
  Vector3 spin{0.0, 0.0, 1.0};  ///< kSpin: in I
  double spin_rate_rad_s = 0.0;
};
std::vector<LineView> pass_views(const LinePass& pass, const LineStation& station, RandomStream random);

}  // namespace pharos::sim
