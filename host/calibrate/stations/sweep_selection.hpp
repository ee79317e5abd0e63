// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/stations/station_bundle.hpp"

namespace pharos::calibrate {

/// How far hits may be from what the unknowns say.
struct SelectionGates {
  double hit_rad = 0.0;    // of one hit from the median of its sweep
  double sweep_rad = 0.0;  // of that median from zero
};

struct Selection {
  std::vector<UsedSweep> sweeps;
  std::size_t hits = 0;       // of sweeps within the motion
  std::size_t hits_left = 0;  // of those: reflections, other light
  std::size_t sweeps_left = 0;
};

/// The sweeps within the motion, of each sensor the hit that is nearest to the median, without what the gates refuse.
Selection select_sweeps(const std::vector<network::PlaneSweep>& sweeps, const StationUnknowns& unknowns,
                        const SelectionGates& gates);

/// Leaves out pieces of motion that do not fit, as where a flat target's attitude is the mirrored one: the largest
/// residual of nine of ten of their sweeps is beyond 2.5 times that of the middle piece. Returns how many were left
/// out.
std::size_t drop_pieces(const std::vector<network::PlaneSweep>& sweeps, StationUnknowns& unknowns,
                        const SelectionGates& gates);

}  // namespace pharos::calibrate
