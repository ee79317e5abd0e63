// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "pharos/network/linearised_sweep.hpp"
#include "pharos/network/network_state.hpp"
#include "pharos/network/position_fix.hpp"

namespace pharos::network {

/// Interacting multiple models over NetworkState: a body at rest and three that move, of increasing white jerk, each
/// with its probability.
class NetworkFilter {
 public:
  static constexpr std::size_t kMoving = 3;
  static constexpr std::size_t kModels = 1 + kMoving;  // 0 is the body at rest

  /// At a pose that one station's sweeps gave, good to half a radian and 0.3 m.
  void start(const WorldFromBody& pose);
  /// Position and its rates are known anew, `doubted` where a sweep may be a reflection; attitude and its rate stay as
  /// they are.
  void place(const PositionFix& fix, bool doubted);
  void predict(double dt_s);
  /// No model explains the last sweeps: the one of most jerk forgets its rates.
  void reset_rates();

  /// The mixture: moments of the pose and of all others.
  const NetworkState& mean() const { return mean_; }
  /// The model of most jerk: what may be where light does not tell which model holds.
  const NetworkState& widest() const { return model_.back(); }
  /// Chi-squared of a sweep's innovation for the model of most jerk, and its degrees of freedom.
  double widest_chi2(const LinearisedSweep& sweep) const;
  /// Adds a sweep; returns -2 ln of its likelihood.
  double correct(const LinearisedSweep& sweep);
  const std::array<double, kModels>& probability() const { return probability_; }

 private:
  void interact(double dt_s);
  void merge();
  bool lost(std::size_t model) const;

  std::array<NetworkState, kModels> model_;
  std::array<double, kModels> probability_{};
  NetworkState mean_;
};

}  // namespace pharos::network
