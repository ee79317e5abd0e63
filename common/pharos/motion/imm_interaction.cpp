// SPDX-License-Identifier: Apache-2.0
// How the models of an ImmFilter pass their estimates on to each other.
#include <algorithm>
#include <cmath>

#include "pharos/motion/imm_onset.hpp"
#include "pharos/motion/state_mixture.hpp"

namespace pharos::motion {
namespace {

// Transition rates per second, from row to column: static, then moving by increasing process noise.
constexpr double kChange[ImmFilter::kModels][ImmFilter::kModels] = {{0.0, 0.1, 0.1, 0.05, 0.01},
                                                                    {0.1, 0.0, 0.2, 0.05, 0.01},
                                                                    {0.1, 0.2, 0.0, 0.5, 0.02},
                                                                    {0.01, 0.02, 1.0, 0.0, 1.0},
                                                                    {0.01, 0.01, 0.02, 1.0, 0.0}};
// Only a slow body becomes stationary between two sweeps: rates, 1 sigma, that friction stops at once.
constexpr double kHaltingRate_rad_s = 0.1, kHaltingVelocity_m_s = 0.03;
// A model with larger sigmas of the pose than these has lost the body: it restarts from the models of lower process
// noise. So does one of negligible probability whose rates are these squared sigmas from those of the next lower one:
// rates that differ by whole rotations a sweep give the same poses, and no sweep would ever contradict them.
constexpr double kAstray = 100.0;
constexpr double kLostRotation_rad = 0.5, kLostPosition_m = 0.5;
constexpr double kMaxFilterStep_s = 0.05;
// Smaller fractions are not mixed; less probable models are not corrected, but restarted from the others.
constexpr double kNegligible = 1e-3;

// Probability that the estimated rates are small enough to stop: the overlap of the two Gaussians, exp and volume.
double may_halt(const MovingState& state) {
  double volume = 1.0, square = 0.0;
  for (int k = 0; k < 6; ++k) {
    const double halting = k < 3 ? kHaltingRate_rad_s : kHaltingVelocity_m_s;
    const double variance = state.rr(k, k) + halting * halting;
    volume *= halting * halting / variance;
    square += state.rate[k] * state.rate[k] / variance;
  }
  return std::sqrt(volume) * std::exp(-0.5 * square);
}

}  // namespace

bool ImmFilter::lost(std::size_t m) const {
  const MovingState& state = moving_[m];
  if (state.pp.topLeftCorner<3, 3>().trace() > kLostRotation_rad * kLostRotation_rad) return true;
  if (state.pp.bottomRightCorner<3, 3>().trace() > kLostPosition_m * kLostPosition_m) return true;
  if (m == 0 || probability_[m + 1] > kNegligible) return false;
  const MovingState& calmer = moving_[m - 1];
  const Vector6 apart = (state.rate - calmer.rate).cwiseAbs2();
  const Vector6 allowed = (state.rr + calmer.rr).diagonal();
  return (apart.array() > kAstray * allowed.array()).any();
}

void ImmFilter::interact(double dt_s) {
  const double dt = std::min(dt_s, kMaxFilterStep_s);
  Flow flow;  // probability of having gone from i to j
  std::array<double, kModels> next{};
  for (std::size_t i = 0; i < kModels; ++i) {
    double stays = 1.0;
    for (std::size_t j = 0; j < kModels; ++j) {
      const double goes = i > 0 && j == 0 ? kChange[i][0] * may_halt(moving_[i - 1]) : kChange[i][j];
      flow[i][j] = probability_[i] * goes * dt;
      stays -= goes * dt;
    }
    flow[i][i] = probability_[i] * stays;
    for (std::size_t j = 0; j < kModels; ++j) next[j] += flow[i][j];
  }
  for (std::size_t m = 0; m < kMoving; ++m) {
    if (!lost(m)) continue;
    if (m == 0) {
      moving_[0] = beginning_to_move(resting_, kOnset[0]);
    } else {
      moving_[m] = moving_[m - 1];
    }
  }
  // Models take over from those of higher process noise, in this order, which leaves every source as it was.
  double sum = flow[0][0];
  for (std::size_t i = 1; i < kModels; ++i) {
    if (flow[i][0] <= kNegligible * next[0]) continue;
    sum += flow[i][0];
    blend(resting_, moving_[i - 1], flow[i][0] / sum, linked_);
  }
  for (std::size_t j = 1; j < kModels; ++j) {
    sum = flow[j][j];
    for (std::size_t i = j + 1; i < kModels; ++i) {
      if (flow[i][j] <= kNegligible * next[j]) continue;
      sum += flow[i][j];
      blend(moving_[j - 1], moving_[i - 1], flow[i][j] / sum, linked_);
    }
  }
  probability_ = next;
}

}  // namespace pharos::motion
