// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pharos::tof {

/// Factor by which correlated noise of neighbours widens the variance of averages around a ring.
///
/// Residuals are summed by sector, longer than noise is correlated; the variance of these sums, each with its
/// neighbours' part, is compared with that of independent residuals (the sandwich estimate of a clustered sample, one
/// number for all unknowns). Sixty-four sectors determine it to some 20 %, without a model of the correlation.
class SectorSums {
 public:
  /// A weighted residual in the direction (du, dv) from the ring's middle.
  void add(double du, double dv, double weight, double residual) {
    const std::size_t k = sector_of(du, dv);
    sum_[k] += weight * residual;
    add(weight, residual);
  }
  /// Many in one direction: their number, sums of the weights, of the weighted residuals and of weighted squares.
  void add_many(double du, double dv, int count, double weights, double sum, double squares) {
    sum_[sector_of(du, dv)] += sum;
    weights_ += weights;
    squares_ += squares;
    count_ += count;
  }
  /// Where only count() and variance() are needed.
  void add(double weight, double residual) {
    weights_ += weight;
    squares_ += weight * residual * residual;
    ++count_;
  }
  int count() const { return count_; }
  /// Variance of a residual of unit weight, without its neighbours.
  double variance() const { return count_ > 0 ? squares_ / count_ : 0.0; }
  /// At least 1: variance of an average over that of independent residuals. `unknowns` were fitted.
  double variance_inflation(int unknowns) const {
    double own = 0.0;
    double across = 0.0;
    int used = 0;
    for (std::size_t k = 0; k < kSectors; ++k) {
      used += sum_[k] != 0.0 ? 1 : 0;
      own += sum_[k] * sum_[k];
      across += sum_[k] * sum_[(k + 1) % kSectors];
    }
    const double independent = variance() * weights_;
    if (!(independent > 0.0)) return 1.0;
    if (used - unknowns < kMinUsed) return std::max(1.0, weights_ > 0.0 ? static_cast<double>(count_) : 1.0);
    const double lost = static_cast<double>(used) / (used - unknowns);
    return std::max(1.0, (1.0 + kUncertain / used) * lost * (own + 2.0 * std::max(0.0, across)) / independent);
  }

 private:
  static constexpr std::size_t kSectors = 64;
  // So few sums determine the variance to a third, and a quotient by an uncertain variance has longer tails: the mean
  // of its inverse, to second order in the six-over-n variance of own squares and neighbours' products.
  static constexpr double kUncertain = 8.0;
  // Where hardly a sector is seen, all residuals may be fully correlated.
  static constexpr int kMinUsed = 8;

  // Grows with the angle of (du, dv); a diamond's perimeter stands for the circle's.
  static std::size_t sector_of(double du, double dv) {
    const double size = std::fabs(du) + std::fabs(dv);
    if (!(size > 0.0)) return 0;
    const double diamond = dv >= 0.0 ? 1.0 - du / size : 3.0 + du / size;  // 0 to 4
    return std::min(kSectors - 1, static_cast<std::size_t>(diamond * (kSectors / 4.0)));
  }

  std::array<double, kSectors> sum_{};
  double weights_ = 0.0;
  double squares_ = 0.0;
  int count_ = 0;
};

}  // namespace pharos::tof
