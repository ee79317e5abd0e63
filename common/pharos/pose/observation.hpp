// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"

namespace pharos::pose {

/// One ideal bearing of one sensor, the paper's theta (002, equations 1 and 2): in the plane swept, from the positive
/// axis, x/z = cot(theta_x), y/z = cot(theta_y); straight ahead is pi/2. Range (0, pi).
///
/// Several observations of one sensor and axis are candidates (the true hit and its reflections): the solver keeps at
/// most one of them.
struct Observation {
  std::uint8_t sensor = 0;  // number in the Target
  Axis axis = Axis::kX;
  double theta_rad = 0.0;
};

/// Maximum observations of one solve: both sweeps of one station, each with every hit a sweep can hold.
inline constexpr std::size_t kMaxObservations = kAxes * kMaxHitsPerSweep;
using Observations = StaticVector<Observation, kMaxObservations>;

}  // namespace pharos::pose
