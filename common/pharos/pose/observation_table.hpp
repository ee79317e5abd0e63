// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"

namespace pharos::pose {

/// The bearings of one cycle, laid out for arithmetic: one entry a sensor, columns side by side.
///
/// Row (sensor, axis) takes part in a fit with weight 1 or 0. Entries are padded to an even count with copies of weight
/// 0, so that two sensors are processed at a time.
struct ObservationTable {
  using Column = std::array<double, kMaxSensors>;
  struct AxisColumns {
    alignas(16) Column cosine;  // of the bearing
    alignas(16) Column sine;
    alignas(16) Column weight;  // 1: takes part, 0: not seen or left out
  };

  int count = 0;  // sensors
  alignas(16) Column body_x;
  alignas(16) Column body_y;
  alignas(16) Column body_z;
  std::array<AxisColumns, kAxes> axis;

  Vector3 body(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {body_x[k], body_y[k], body_z[k]};
  }
  bool seen(int i, Axis a) const {
    return axis[static_cast<std::size_t>(index_of(a))].weight[static_cast<std::size_t>(i)] > 0.0;
  }
  bool seen_by_both(int i) const { return seen(i, Axis::kX) && seen(i, Axis::kY); }

  /// Adds a sensor without bearings; returns its index in this structure. The caller keeps count < kMaxSensors.
  int add(const Vector3& position_m);
  void see(int i, Axis a, double cosine, double sine);
  void leave_out(int i, Axis a) {
    axis[static_cast<std::size_t>(index_of(a))].weight[static_cast<std::size_t>(i)] = 0.0;
  }
  /// To be called after the last add: makes the padding entry.
  void pad();
  /// Rows with weight 1.
  int rows() const;
  /// Sensors with at least one row of weight 1.
  int sensors() const;
  /// Mean body position of the sensors that take part.
  Vector3 body_centroid() const;
};

/// Sensors with both bearings, as points and unit rays: input of the start methods.
struct RaySet {
  int count = 0;
  std::array<Vector3, kMaxSensors> body;  // m, body frame
  std::array<Vector3, kMaxSensors> ray;   // unit, lighthouse frame, from the station to the sensor
};

/// Unit ray of a sensor from the cosines and sines of its two bearings.
Vector3 ray_of(double cosine_x, double sine_x, double cosine_y, double sine_y);

RaySet rays_of(const ObservationTable& table);

}  // namespace pharos::pose
