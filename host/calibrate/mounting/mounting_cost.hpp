// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>

#include "host/calibrate/mounting/mounting_unknowns.hpp"

namespace pharos::calibrate {

template <class T>
using VectorOf = Eigen::Matrix<T, 3, 1>;
template <class T>
using MatrixOf = Eigen::Matrix<T, 3, 3>;

template <class T>
MatrixOf<T> exp_of(const VectorOf<T>& turn) {
  MatrixOf<T> R;
  ceres::AngleAxisToRotationMatrix(turn.data(), R.data());
  return R;
}

template <class T>
VectorOf<T> log_of(const MatrixOf<T>& R) {
  VectorOf<T> turn;
  ceres::RotationMatrixToAngleAxis(R.data(), turn.data());
  return turn;
}

template <class T>
struct PoseOf {
  MatrixOf<T> R;
  VectorOf<T> t;
};

template <class T>
PoseOf<T> moved(const Matrix3& R, const Vector3& t, const T* delta) {
  return {exp_of<T>(VectorOf<T>(delta[0], delta[1], delta[2])) * R.cast<T>(),
          t.cast<T>() + VectorOf<T>(delta[3], delta[4], delta[5])};
}

/// Pose of a segment at u in [0, 1]: cumulative cubic B-spline (Kim, Kim, Shin, "A general construction scheme for unit
/// quaternion curves with simple high order derivatives", SIGGRAPH 1995, for rotations; the same weights for
/// positions).
template <class T>
PoseOf<T> spline_pose(const std::array<PoseOf<T>, 4>& c, const T& u) {
  const T u2 = u * u, u3 = u2 * u;
  const T w1 = (5.0 + 3.0 * u - 3.0 * u2 + u3) / 6.0, w2 = (1.0 + 3.0 * u + 3.0 * u2 - 2.0 * u3) / 6.0, w3 = u3 / 6.0;
  PoseOf<T> out = c[0];
  const std::array<T, 3> weight{w1, w2, w3};
  for (std::size_t i = 0; i < 3; ++i) {
    const VectorOf<T> turn = log_of<T>(c[i + 1].R * c[i].R.transpose());
    out.R = exp_of<T>(VectorOf<T>(weight[i] * turn)) * out.R;
    out.t += weight[i] * (c[i + 1].t - c[i].t);
  }
  return out;
}

/// A row of a source against the motion: six residuals of unit variance (five and a zero without turn).
///
/// measured = predicted moved by noise and slow error; predicted = T_vehicle_sensor^-1 T_vehicle_target
/// T_target_feature.
struct RowCost {
  // Parameters: four control points, sensor, feature (6 each), offset (1), two slow errors (6 each), scale (1).
  static constexpr std::array<int, 10> kSizes{6, 6, 6, 6, 6, 6, 1, 6, 6, 1};

  std::array<UnknownPose, 4> control;
  UnknownPose sensor, feature;
  double time_s = 0.0;  // on the source's clock
  double segment_begin_s = 0.0, knot_s = 0.4;
  double slow_begin_s = 0.0, slow_step_s = 15.0;
  host::SensorFromFeature measured;
  bool has_turn = true;
  Matrix6 whitening = Matrix6::Identity();  // of delta; of no turn: of two rotations across the axis, three positions

  template <class T>
  void errors(const T* const* p, VectorOf<T>& rotation, VectorOf<T>& position) const {
    std::array<PoseOf<T>, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = moved<T>(control[i].R, control[i].t, p[i]);
    const T time = time_s + p[6][0];
    const PoseOf<T> target = spline_pose<T>(c, T((time - segment_begin_s) / knot_s));
    const PoseOf<T> x = moved<T>(sensor.R, sensor.t, p[4]), y = moved<T>(feature.R, feature.t, p[5]);
    const MatrixOf<T> R = x.R.transpose() * target.R * y.R;
    const VectorOf<T> t = x.R.transpose() * (target.R * y.t + target.t - x.t);
    const T v = (time - slow_begin_s) / slow_step_s;
    VectorOf<T> slow_rotation, slow_position;
    for (int i = 0; i < 3; ++i) {
      slow_rotation[i] = p[7][i] + v * (p[8][i] - p[7][i]);
      slow_position[i] = p[7][3 + i] + v * (p[8][3 + i] - p[7][3 + i]);
    }
    position = measured.t.cast<T>() - (T(1.0) + p[9][0]) * t - slow_position;
    if (has_turn) {
      rotation = log_of<T>(measured.R.cast<T>() * R.transpose()) - slow_rotation;
    } else {
      const VectorOf<T> n = R.col(2), n_measured = measured.R.col(2).cast<T>();
      rotation = n.cross(n_measured) - (slow_rotation - n_measured * n_measured.dot(slow_rotation));
    }
  }

  template <class T>
  bool operator()(const T* const* p, T* residual) const {
    VectorOf<T> rotation, position;
    errors<T>(p, rotation, position);
    Eigen::Matrix<T, 6, 1> error;
    if (has_turn) {
      error << rotation, position;
    } else {
      error << measured.R.col(0).cast<T>().dot(rotation), measured.R.col(1).cast<T>().dot(rotation), position, T(0.0);
    }
    (Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual)) = whitening.cast<T>() * error;
    return true;
  }
};

}  // namespace pharos::calibrate
