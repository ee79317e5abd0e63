// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pharos/network/station.hpp"

namespace pharos::calibrate {

/// Weights of the four control points that an instant depends on: uniform cubic B-spline.
struct SplineBasis {
  std::size_t first = 0;
  std::array<double, 4> weight{};        // sum 1
  std::array<double, 4> acceleration{};  // second derivatives by time, 1/s^2
};

/// A body's uninterrupted motion: position = sum w_i c_i, R = exp(sum w_i turn_i) R_reference(t), where R_reference
/// turns evenly from one control time to the next. Control point j stands at begin + (j - 1) step.
///
/// `turn` is small: rebase() moves it into the reference, so that one chart never holds a large rotation.
class BodySpline {
 public:
  /// A spline over [begin_s, end_s] whose control points are `pose_at` their times.
  template <class PoseAt>
  BodySpline(double begin_s, double end_s, double step_s, PoseAt pose_at) : begin_s_(begin_s), step_s_(step_s) {
    segments_ = static_cast<std::size_t>((end_s - begin_s) / step_s) + 1;
    for (std::size_t j = 0; j < segments_ + 3; ++j) {
      const network::WorldFromBody pose = pose_at(control_time_s(j));
      position.push_back({pose.t.x(), pose.t.y(), pose.t.z()});
      turn.push_back({0.0, 0.0, 0.0});
      reference_.push_back(pose.R);
    }
  }

  double begin_s() const { return begin_s_; }
  double end_s() const { return begin_s_ + static_cast<double>(segments_) * step_s_; }
  double step_s() const { return step_s_; }
  std::size_t segments() const { return segments_; }
  double control_time_s(std::size_t j) const { return begin_s_ + (static_cast<double>(j) - 1.0) * step_s_; }
  bool holds(double time_s) const { return time_s >= begin_s_ && time_s <= end_s(); }

  SplineBasis basis(double time_s) const;
  /// The same of the piece whose first control point is `first`, at a time near it.
  SplineBasis basis_of(std::size_t first, double time_s) const;
  Matrix3 reference(double time_s) const;
  network::WorldFromBody pose(double time_s) const;
  Vector3 velocity_m_s(double time_s) const;
  Vector3 acceleration_m_s2(double time_s) const;

  /// Rotation vector from control j's reference to control k's.
  Vector3 reference_turn(std::size_t j, std::size_t k) const;
  void rebase();

  // Control points, as blocks of an optimiser.
  std::vector<std::array<double, 3>> position;  // m, world
  std::vector<std::array<double, 3>> turn;      // rad, world

 private:
  double begin_s_ = 0.0, step_s_ = 0.0;
  std::size_t segments_ = 0;
  std::vector<Matrix3> reference_;
};

}  // namespace pharos::calibrate
