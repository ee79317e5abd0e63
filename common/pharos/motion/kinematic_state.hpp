// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/geometry/pose.hpp"
#include "pharos/motion/station_relative.hpp"
#include "pharos/motion/sweep_information.hpp"
#include "pharos/motion/tilt.hpp"

namespace pharos::motion {

/// Innovation of a sweep and its covariance, before the correction, in the sweep's own whitened coordinates.
struct Innovation {
  Matrix6 side;          // P L, without its column that is zero
  Matrix6 factor;        // C of I + L^T P L = C C^T: below the diagonal, where L's columns are not zero
  Vector6 inverse_root;  // there, 1 over C's diagonal
  Vector6 whitened = Vector6::Zero();
  double chi2 = 0.0;     // of the prediction's part
  double log_det = 0.0;  // of I + L^T P L
};

/// Innovation of a sweep for a state whose pose error has this covariance; `offset`: the state's pose minus the one
/// that the sweep was linearised at.
Innovation innovation_of(const SweepInformation& sweep, const Matrix6& pose_covariance, const Vector6& offset);

/// Correction of the pose by its innovation.
Vector6 pose_shift(const SweepInformation& sweep, const Innovation& innovation);

/// Covariance of that pose, `covariance` before, after its correction by the innovation.
Matrix6 corrected_covariance(const Matrix6& covariance, const SweepInformation& sweep, const Innovation& innovation);

/// Whose sweep it is: that of the station in whose frame the belief is kept, or that of a second one.
enum class Observer : std::uint8_t { kReference, kSecond };

/// The part of the state that belongs to a second station: T_second_reference, and the covariance of its error (s,
/// Pose::moved_by) with itself and with the errors of pose, rate and acceleration; sp = E[s error x pose error^T].
struct SecondStation {
  StationFromStation pose;
  Matrix6 ss = Matrix6::Zero(), sp = Matrix6::Zero(), sr = Matrix6::Zero(), sa = Matrix6::Zero();
};

/// Derivatives of the error of the pose that the second station sees, T_second_body, by the errors of T_reference_body
/// and of T_second_reference.
struct SecondView {
  SecondView(const LighthouseFromBody& body, const StationFromStation& second);
  LighthouseFromBody pose;  // T_second_body
  Matrix6 by_body, by_second;
};

/// Covariance of the pose seen from the second station.
Matrix6 seen_covariance(const SecondView& view, const Matrix6& pp, const SecondStation& second);

/// State of the static model: a pose and the covariance of its error (Pose::moved_by).
struct RestingState {
  LighthouseFromBody pose;
  Matrix6 covariance = Matrix6::Zero();
  SecondStation second;  // sr and sa stay zero

  void correct(const SweepInformation& sweep, const Innovation& innovation, bool linked);
  /// A sweep of the second station.
  void correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view);
  /// Not of one with a second station.
  void mirror(const Tilt& tilt);
};

/// Gaussian state of a moving model: pose, rate and acceleration.
///
/// Mean: T_lighthouse_body; rate (angular velocity rad/s, then velocity of the body's origin m/s) and its derivative,
/// in the lighthouse frame. Error: delta of Pose::moved_by, then differences of rate and acceleration. Covariance by
/// blocks: of pose (p), rate (r), acceleration (a) and across; rp = E[rate error x pose error^T].
struct MovingState {
  LighthouseFromBody pose;
  Vector6 rate = Vector6::Zero();
  Vector6 acceleration = Vector6::Zero();
  Matrix6 pp = Matrix6::Zero(), rp = Matrix6::Zero(), rr = Matrix6::Zero();
  Matrix6 ap = Matrix6::Zero(), ar = Matrix6::Zero(), aa = Matrix6::Zero();
  SecondStation second;

  /// Predicts by dt_s under white jerk of spectral density `jerk_rotation` (rad/s^3)^2 s and `jerk_translation`
  /// (m/s^3)^2 s. Exact but for the coupling of rates across one step: keep |angular velocity| dt below 0.1 rad.
  void predict(double dt_s, double jerk_rotation, double jerk_translation);
  /// What predict() does to the covariance with a second station.
  void predict_second(double dt_s);
  void predict_mean(double dt_s);
  /// A sweep of the reference station; `linked`: a second station is part of the state and is corrected too.
  void correct(const SweepInformation& sweep, const Innovation& innovation, bool linked);
  void correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view);
  /// Tilted to the other side, from the same motion of the sensors; not of one with a second station.
  void mirror(const Tilt& tilt);
};

}  // namespace pharos::motion
