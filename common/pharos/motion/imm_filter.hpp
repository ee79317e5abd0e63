// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/motion/kinematic_state.hpp"

namespace pharos::motion {

/// State estimate of the whole filter: moments of the mixture, in the frame of the observing station.
struct StateEstimate {
  LighthouseFromBody pose;
  Matrix6 covariance = Matrix6::Zero();       // of the pose error
  Vector6 rate = Vector6::Zero();             // rad/s, m/s, lighthouse frame
  double rotation_rate_variance = 0.0;        // of one component, (rad/s)^2
  double velocity_variance = 0.0;             // of one component, (m/s)^2
  Matrix6 gate_covariance = Matrix6::Zero();  // if the model of highest process noise were certain; for gates
};

/// Interacting multiple models (Blom and Bar-Shalom, "The interacting multiple model algorithm", 1988): one static
/// model and four constant-acceleration models of increasing process noise (white jerk), each with its probability.
/// This adapts the process noise at once, and without a detector.
///
/// Once linked, the pose of a second station is part of every model's state and is estimated too.
class ImmFilter {
 public:
  static constexpr std::size_t kMoving = 4;
  static constexpr std::size_t kModels = 1 + kMoving;  // 0 is the static model

  /// Only the pose is known: sigmas of rotation (rad) and position (m); optionally a rough rate (rad/s, m/s), from two
  /// poses one or two rotor revolutions apart.
  void start(const LighthouseFromBody& pose, double sigma_rotation_rad, double sigma_position_m, const Vector6* rate);
  /// Mixes the models' estimates (interaction) and predicts each by dt_s.
  void predict(double dt_s);
  /// Predicts the means alone, also backwards.
  void predict_mean(double dt_s);
  /// No model explains the last dt_s (impact, docking): resets the rate covariance of the model with the highest
  /// process noise.
  void reset_rates(double dt_s);
  /// Coplanar sensors tilted to the other side; only when not linked.
  void mirror(const Tilt& tilt);
  /// From here on a second station takes part, with this pose and covariance.
  void link(const StationFromStation& T_second_reference, const Matrix6& covariance);
  /// Adds to the covariance of the second station's pose error.
  void inflate_relative_covariance(const Matrix6& covariance);
  /// T_second_reference and its covariance, of the most probable model; only when linked.
  const SecondStation& second() const;
  bool linked() const { return linked_; }

  StateEstimate state_estimate(Observer observer = Observer::kReference) const;
  /// Adds a sweep that was linearised at `pose`; returns -2 ln of its likelihood but for constants of the noise. Of the
  /// second station only when linked; `pose` is then in that one's frame.
  double correct(const SweepInformation& sweep, const LighthouseFromBody& pose,
                 Observer observer = Observer::kReference);

  const std::array<double, kModels>& probability() const { return probability_; }
  /// Hardly any of it is of the two models of high process noise: no hand shakes the body, which has another attitude
  /// error in every sweep then.
  bool steady() const { return probability_[kMoving] + probability_[kMoving - 1] < kShaken; }
  /// Hardly any of it is of the model of highest process noise: the body is not shaken, and surprises are not its own.
  bool quiet() const { return probability_[kMoving] < kShaken; }

 private:
  static constexpr double kShaken = 0.3;
  using Flow = std::array<std::array<double, kModels>, kModels>;
  // The models' poses, as they are or as the second station sees them.
  struct Seen {
    LighthouseFromBody pose;
    Matrix6 covariance;
  };
  struct Views {
    std::array<const LighthouseFromBody*, kModels> pose;
    std::array<const Matrix6*, kModels> covariance;
  };
  Views own_views() const;
  Seen seen_by_second(std::size_t model) const;
  StateEstimate moments(const Views& views, double min_counted) const;
  std::size_t most_probable() const;
  template <class State>
  void correct_one(State& state, const SweepInformation& sweep, const Innovation& innovation, Observer observer);
  bool lost(std::size_t moving) const;
  void interact(double dt_s);

  RestingState resting_;
  std::array<MovingState, kMoving> moving_;
  std::array<double, kModels> probability_{};
  bool linked_ = false;
};

}  // namespace pharos::motion
