// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "host/calibrate/stations/station_unknowns.hpp"

namespace pharos::calibrate {

/// The constants of a sweep in one adjustment.
struct SweepRows {
  const network::PlaneSweep* sweep = nullptr;
  network::Generation generation = network::Generation::kLighthouse1;
  network::WorldFromStation T_world_station;  // the station block's delta is relative to it
  std::size_t first_control = 0;
  std::vector<std::array<double, 4>> weight;  // of the four control points, by hit
  std::vector<Matrix3> reference;             // R_world_body by hit, before `turn`
  PlaneNoise noise;
};

SweepRows sweep_rows(const network::PlaneSweep& sweep, const network::Station& station, const BodySpline& motion,
                     const PlaneNoise& noise);

/// A row a hit, measured - model, whitened with the sweep's common part.
/// Blocks: 4 positions (3), 4 turns (3), station delta (6), plane fields (7), the sensor of each hit (3).
ceres::CostFunction* sweep_cost(const SweepRows& rows);

/// White jerk of a density q over a segment: (c3 - 3 c2 + 3 c1 - c0 + offset) / sqrt(q step^5).
/// Blocks: 4 control points (3).
ceres::CostFunction* jerk_cost(const Vector3& offset, double density, double step_s);

}  // namespace pharos::calibrate
