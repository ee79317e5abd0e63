// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tools/sim/pointing/pointing_scenario.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// Where the sun stands: between the line of sight and the panel's normal, somewhere near.
Vector3 sun_for(const PointingView& view, RandomStream& random);

/// Attitudes drawn at random: line of sight, axis and roll.
struct RandomPointingViews {
  int count = 50;
  double range_m = 100.0;
  double min_elevation_rad = 0.35;
  double max_elevation_rad = 1.3;
  double min_from_sight_rad = 0.52;  ///< between axis and line of sight
  double max_roll_rad = 0.8;
};
std::vector<PointingView> random_views(const RandomPointingViews& limits, RandomStream random);

/// A pass over the station on a circular orbit, images evenly spaced about the culmination.
struct PointingPass {
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
std::vector<PointingView> pass_views(const PointingPass& pass, const PointingStation& station, RandomStream random);

}  // namespace pharos::sim
