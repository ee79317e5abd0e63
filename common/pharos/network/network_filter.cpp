// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_filter.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::network {
namespace {

constexpr std::size_t kModels = NetworkFilter::kModels;

// White jerk of the moving models, (rad/s^3)^2 s and (m/s^3)^2 s: a drone's hovering, its flight, a hand.
struct Jerk {
  double rotation, translation;
};
constexpr std::array<Jerk, NetworkFilter::kMoving> kJerk{{{0.03, 0.003}, {10.0, 2.0}, {3000.0, 400.0}}};
// Sigmas at the onset of motion and where nothing is known: rad/s, m/s, rad/s^2, m/s^2.
constexpr std::array<std::array<double, 4>, NetworkFilter::kMoving> kOnset{
    {{0.05, 0.03, 0.1, 0.05}, {0.3, 0.1, 1.0, 0.5}, {1.0, 0.3, 10.0, 3.0}}};
constexpr std::array<std::array<double, 4>, NetworkFilter::kMoving> kUnknown{
    {{1.0, 0.7, 0.5, 0.5}, {2.0, 1.5, 2.0, 2.0}, {6.0, 3.0, 30.0, 10.0}}};
// Transition rates a second, from row to column: at rest, then by jerk.
constexpr double kChange[kModels][kModels] = {
    {0.0, 0.2, 0.1, 0.05}, {0.2, 0.0, 0.3, 0.05}, {0.05, 0.3, 0.0, 0.5}, {0.01, 0.05, 1.0, 0.0}};
constexpr double kHaltingRate_rad_s = 0.1, kHaltingVelocity_m_s = 0.02;
constexpr double kNegligible = 1e-3;
constexpr double kMinProbability = 1e-9;
constexpr double kMaxStep_s = 0.02;
constexpr double kMinVariance = 1e-16;  // rad^2
constexpr double kStartRotation_rad = 0.5, kStartPosition_m = 0.3;
constexpr double kLostRotation_rad = 1.0, kLostPosition_m = 0.6;

// Probability that the rates are small enough to stop: the overlap of the two Gaussians, exp and volume.
double may_halt(const NetworkState& state) {
  double volume = 1.0, square = 0.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double halting = k < 3 ? kHaltingRate_rad_s : kHaltingVelocity_m_s;
    const double variance = state.covariance(kRateAt + k, kRateAt + k) + halting * halting;
    volume *= halting * halting / variance;
    square += state.rate[k] * state.rate[k] / variance;
  }
  return std::sqrt(volume) * std::exp(-0.5 * square);
}

// Moments of a mixture of two estimates, the second with the fraction `weight`.
void blend(NetworkState& into, const NetworkState& other, double weight) {
  const StateVector apart = other.difference(into);
  into.covariance += weight * (other.covariance - into.covariance);
  into.covariance += ((weight * (1.0 - weight)) * apart).lazyProduct(apart.transpose());
  into.move_by(weight * apart);
}

void clear_rates(NetworkState& state) { state.reset_rates({0.0, 0.0, 0.0, 0.0}); }

using Gain = Eigen::Matrix<double, Eigen::Dynamic, kStateSize, Eigen::RowMajor, kMaxSweepHits, kStateSize>;

// Innovation of a sweep, whitened: with S = H P H^T + R = C C^T, C^-1 r and C^-1 H P.
struct Innovation {
  HitVector residual;
  Gain gain;
  double chi2 = 0.0;
  double log_det = 0.0;
};

// Loops, as Eigen's blocked solvers of dynamic size use the heap.
Innovation innovation_of(const LinearisedSweep& sweep, const NetworkState& state) {
  Innovation out;
  const StateVector apart = state.difference(sweep.at);
  out.residual = sweep.residual - sweep.rows.lazyProduct(apart.head<kObserved>());
  out.gain = sweep.rows.lazyProduct(state.covariance.topRows<kObserved>());
  HitSquare S = out.gain.leftCols<kObserved>().lazyProduct(sweep.rows.transpose());
  const Eigen::Index n = S.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      double sum = S(i, j) + sweep.common_variance + (i == j ? sweep.variance[i] : 0.0);
      for (Eigen::Index k = 0; k < j; ++k) sum -= S(i, k) * S(j, k);
      S(i, j) = i == j ? std::sqrt(std::max(sum, kMinVariance)) : sum / S(j, j);
    }
    for (Eigen::Index k = 0; k < i; ++k) {
      out.residual[i] -= S(i, k) * out.residual[k];
      out.gain.row(i) -= S(i, k) * out.gain.row(k);
    }
    out.residual[i] /= S(i, i);
    out.gain.row(i) /= S(i, i);
    out.chi2 += out.residual[i] * out.residual[i];
    out.log_det += 2.0 * std::log(S(i, i));
  }
  return out;
}

void correct_one(NetworkState& state, const Innovation& innovation) {
  state.covariance -= innovation.gain.transpose().lazyProduct(innovation.gain);
  state.move_by(innovation.gain.transpose().lazyProduct(innovation.residual));
}

}  // namespace

void NetworkFilter::start(const WorldFromBody& pose) {
  NetworkState begin;
  begin.pose = pose;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double sigma = k < 3 ? kStartRotation_rad : kStartPosition_m;
    begin.covariance(k, k) = sigma * sigma;
  }
  model_[0] = begin;
  for (std::size_t m = 0; m < kMoving; ++m) {
    model_[m + 1] = begin;
    model_[m + 1].reset_rates(kUnknown[m]);
  }
  probability_ = {0.3, 0.2, 0.25, 0.25};
  merge();
}

bool NetworkFilter::lost(std::size_t m) const {
  const StateMatrix& P = model_[m].covariance;
  return P.topLeftCorner<3, 3>().trace() > kLostRotation_rad * kLostRotation_rad ||
         P.block<3, 3>(3, 3).trace() > kLostPosition_m * kLostPosition_m;
}

void NetworkFilter::interact(double dt_s) {
  double flow[kModels][kModels];
  std::array<double, kModels> next{};
  for (std::size_t i = 0; i < kModels; ++i) {
    double stays = 1.0;
    for (std::size_t j = 0; j < kModels; ++j) {
      const double goes = (i > 0 && j == 0 ? kChange[i][0] * may_halt(model_[i]) : kChange[i][j]) * dt_s;
      flow[i][j] = probability_[i] * goes;
      stays -= goes;
    }
    flow[i][i] = probability_[i] * stays;
    for (std::size_t j = 0; j < kModels; ++j) next[j] += flow[i][j];
  }
  // Models of more jerk run on their own, as one that is overwritten by a quieter one never widens; they restart from
  // the next quieter one where they have lost the body.
  for (std::size_t m = 1; m < kModels; ++m) {
    if (!lost(m)) continue;
    model_[m] = model_[m - 1];
    if (m == 1) model_[m].reset_rates(kOnset[0]);
  }
  double sum = flow[0][0];
  for (std::size_t i = 1; i < kModels; ++i) {
    if (flow[i][0] <= kNegligible * next[0]) continue;
    sum += flow[i][0];
    blend(model_[0], model_[i], flow[i][0] / sum);
  }
  clear_rates(model_[0]);
  for (std::size_t j = 1; j < kModels; ++j) {
    sum = flow[j][j];
    for (std::size_t i = j + 1; i < kModels; ++i) {
      if (flow[i][j] <= kNegligible * next[j]) continue;
      sum += flow[i][j];
      blend(model_[j], model_[i], flow[i][j] / sum);
    }
  }
  probability_ = next;
}

void NetworkFilter::predict(double dt_s) {
  if (!(dt_s > 0.0)) return;
  interact(std::min(dt_s, 0.1));
  const int steps = static_cast<int>(std::ceil(dt_s / kMaxStep_s));
  for (int k = 0; k < steps; ++k) {
    const double step_s = dt_s / steps;
    model_[0].predict_at_rest(step_s);
    for (std::size_t m = 0; m < kMoving; ++m) {
      model_[m + 1].predict(step_s, kJerk[m].rotation, kJerk[m].translation);
    }
  }
  merge();
}

void NetworkFilter::reset_rates() {
  NetworkState& widest = model_.back();
  widest = mean_;
  widest.reset_rates(kUnknown.back());
  // What an unforeseen velocity has done since the last sweep.
  for (Eigen::Index k = 0; k < 6; ++k) widest.covariance(k, k) += k < 3 ? 0.01 : 0.0025;
  probability_ = {0.005, 0.005, 0.05, 0.94};
  merge();
}

void NetworkFilter::place(const PositionFix& fix, bool doubted) {
  FixMatrix covariance = fix.covariance;
  if (doubted) covariance.topLeftCorner<3, 3>() = fix.doubted_covariance();
  for (NetworkState& state : model_) state.place(fix.position_m, fix.velocity_m_s, fix.acceleration_m_s2, covariance);
  clear_rates(model_[0]);
  probability_ = {0.1, 0.2, 0.35, 0.35};
  const auto speed2 = fix.velocity_m_s.dot(fix.covariance.block<3, 3>(3, 3).inverse() * fix.velocity_m_s);
  probability_[0] *= std::exp(-0.5 * std::min(40.0, speed2));
  merge();
}

void NetworkFilter::merge() {
  const auto top =
      static_cast<std::size_t>(std::max_element(probability_.begin(), probability_.end()) - probability_.begin());
  mean_ = model_[top];
  double sum = probability_[top];
  for (std::size_t i = 0; i < kModels; ++i) {
    if (i == top || probability_[i] < 1e-6) continue;
    sum += probability_[i];
    blend(mean_, model_[i], probability_[i] / sum);
  }
}

double NetworkFilter::widest_chi2(const LinearisedSweep& sweep) const {
  return innovation_of(sweep, model_.back()).chi2;
}

double NetworkFilter::correct(const LinearisedSweep& sweep) {
  std::array<double, kModels> cost{};
  double minimum = 1e300;
  for (std::size_t i = 0; i < kModels; ++i) {
    const Innovation innovation = innovation_of(sweep, model_[i]);
    cost[i] = innovation.chi2 + innovation.log_det;
    minimum = std::min(minimum, cost[i]);
    correct_one(model_[i], innovation);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kModels; ++i) {
    probability_[i] *= std::exp(-0.5 * (cost[i] - minimum));
    sum += probability_[i];
  }
  double total = 0.0;
  for (double& p : probability_) {
    p = std::max(p / sum, kMinProbability);
    total += p;
  }
  for (double& p : probability_) p /= total;
  merge();
  return minimum - 2.0 * std::log(sum);
}

}  // namespace pharos::network
