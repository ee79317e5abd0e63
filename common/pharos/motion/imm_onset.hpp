// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/motion/imm_filter.hpp"

namespace pharos::motion {

/// Standard deviations at the onset of motion: rate and acceleration, rotation (rad) and translation (m).
struct Onset {
  double rotation_rate, velocity, rotation_acceleration, acceleration;
};

/// Of each moving model: a body at rest begins to move; its rate is roughly known; nothing is known of it.
inline constexpr std::array<Onset, ImmFilter::kMoving> kOnset{
    {{0.05, 0.02, 0.1, 0.03}, {0.1, 0.05, 0.3, 0.1}, {0.3, 0.1, 2.0, 0.5}, {1.0, 0.3, 10.0, 3.0}}};
inline constexpr std::array<Onset, ImmFilter::kMoving> kRoughlyKnown{
    {{1.0, 0.5, 0.3, 0.1}, {1.0, 0.5, 1.0, 0.5}, {2.0, 1.0, 10.0, 3.0}, {4.0, 1.5, 100.0, 50.0}}};
inline constexpr std::array<Onset, ImmFilter::kMoving> kUnknown{
    {{2.0, 1.0, 0.3, 0.1}, {2.0, 1.0, 1.0, 0.5}, {5.0, 3.0, 10.0, 3.0}, {15.0, 5.0, 100.0, 50.0}}};

/// A diagonal covariance of rotation and translation, or of their rates.
void set_variances(Matrix6& covariance, double rotation_sigma, double translation_sigma);

MovingState beginning_to_move(const RestingState& resting, const Onset& onset);

}  // namespace pharos::motion
