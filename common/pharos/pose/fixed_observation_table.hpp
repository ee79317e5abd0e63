// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>

#include "pharos/base/fixed_point.hpp"
#include "pharos/pose/observation.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::pose {

using FixedVector = std::array<std::int32_t, 3>;

/// A pose in integers: position of the sensors' centroid, and rotation of the body about it.
struct FixedPose {
  std::array<FixedVector, 3> column{};  // of R, Q30
  FixedVector centroid{};               // in the table's unit of length, Q30
};

/// One cycle's bearings in integers, one hit a sensor and axis: ObservationTable for cores without a floating-point
/// unit.
///
/// Rotation is taken about the centroid of the sensors seen, and lengths are scaled twice, by the target's size and by
/// its distance: so every row of the Jacobian is of the order of one.
struct FixedObservationTable {
  struct Sensor {
    FixedVector body;  // from the centroid, in units of 2^body_exponent m, Q30; shorter than 1
    std::array<fixed::Q30, kAxes> cosine, sine;
    std::array<bool, kAxes> seen;
  };

  std::array<Sensor, kMaxSensors> sensor;  // the first `count` are used
  int count = 0;
  int rows = 0;
  std::array<std::int64_t, 3> centre{};  // the centroid in the body frame, 2^-40 m
  int body_exponent = 0;
  int length_exponent =
      0;  // unit of length: 2^length_exponent m; the centroid is between half of it and all of it away
  std::bitset<kMaxObservations> used;
};

/// Fills the table for a start from `prior`. False where the observations do not suit this arithmetic (two hits of one
/// sensor and axis, an invalid bearing, a target larger than its distance): the caller falls back to pose::solve.
bool collect_fixed(const Target& target, const Observations& observations, const LighthouseFromBody& prior,
                   FixedObservationTable& table);

FixedPose fixed_pose(const FixedObservationTable& table, const LighthouseFromBody& pose);
/// Orthonormal to double precision.
LighthouseFromBody double_pose(const FixedObservationTable& table, const FixedPose& pose);

/// A body vector rotated into the lighthouse frame.
FixedVector turned(const FixedPose& pose, const FixedVector& body);

}  // namespace pharos::pose
