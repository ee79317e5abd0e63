// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/motion/kinematic_state.hpp"

namespace pharos::motion {

/// Where the body is, as the whole bank sees it: moments of the mixture, in the frame of the station that looks.
struct StateEstimate {
  LighthouseFromBody pose;
  Matrix6 covariance = Matrix6::Zero();       // of the pose error
  Vector6 rate = Vector6::Zero();             // rad/s, m/s, lighthouse frame
  double rotation_rate_variance = 0.0;        // of one component, (rad/s)^2
  double velocity_variance = 0.0;             // of one component, (m/s)^2
  Matrix6 gate_covariance = Matrix6::Zero();  // covariance if the wildest motion were certain: what gates must allow
};

/// Interacting multiple models (Blom and Bar-Shalom, "The interacting multiple model algorithm", 1988): one belief that
/// the body rests and four that it moves, evenly, calmly, briskly, wildly, each with its probability. This is what
/// adapts the process noise: at once, and without a detector.
///
/// Once linked, every belief also knows where a second station stands, and learns of it: that pose is part of the
/// state.
class ImmFilter {
 public:
  static constexpr std::size_t kMoving = 4;
  static constexpr std::size_t kModels = 1 + kMoving;  // 0 rests

  /// Nothing is known but about where: sigmas of rotation (rad) and position (m); and perhaps a rough rate (rad/s,
  /// m/s), from two poses a turn or two apart.
  void start(const LighthouseFromBody& pose, double sigma_rotation_rad, double sigma_position_m, const Vector6* rate);
  /// Moves all beliefs on by dt_s, after each has taken over what the others know (interaction).
  void predict(double dt_s);
  /// Moves the means alone, also backwards.
  void predict_mean(double dt_s);
  /// The last dt_s brought what none of the beliefs allows for: a blow, a catch. The wildest one now holds it possible
  /// that the rates are anything.
  void reset_rates(double dt_s);
  /// From here on a second station takes part, which stands there as far as is known.
  void link(const StationFromStation& T_second_reference, const Matrix6& covariance);
  /// The second station's pose is known less well by that much (covariance of its error).
  void inflate_relative_covariance(const Matrix6& covariance);
  /// T_second_reference and its covariance, of the most probable belief; only when linked.
  const SecondStation& second() const;
  bool linked() const { return linked_; }

  StateEstimate state_estimate(Observer observer = Observer::kReference) const;
  /// Adds a sweep that was linearised at `pose`; -2 ln of its likelihood but for constants of the noise. Of the second
  /// station only when linked; `pose` is then in that one's frame.
  double correct(const SweepInformation& sweep, const LighthouseFromBody& pose,
                 Observer observer = Observer::kReference);

  const std::array<double, kModels>& probability() const { return probability_; }

 private:
  using Flow = std::array<std::array<double, kModels>, kModels>;
  struct Seen {
    LighthouseFromBody pose;
    Matrix6 covariance;
  };
  Seen seen(std::size_t model, Observer observer) const;
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
