// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::tof {

/// Residuals of a fitted face's outline, summed over pieces of its sides. Where neighbouring pixels share their noise,
/// these sums are larger than the scatter of single pixels lets expect, and so are the errors of the fit.
class OutlineScatter {
 public:
  /// `side`: 0 to 3; `along`: from -1 to 1 on it; `by_edge`: derivative of the pixel's light by the edge's place.
  void add(int side, double along, double by_edge, double residual) {
    const int piece = std::clamp(static_cast<int>(0.5 * (along + 1.0) * kPieces), 0, kPieces - 1);
    const auto index = static_cast<std::size_t>(side * kPieces + piece);
    information_[index] += by_edge * by_edge;
    moment_[index] += by_edge * residual;
  }

  /// Variance of the pieces over that of independent pixels of deviation `sigma`.
  double ratio(double sigma) const {
    double chi2 = 0.0;
    int pieces = 0;
    for (std::size_t i = 0; i < information_.size(); ++i) {
      if (!(information_[i] > 0.0)) continue;
      chi2 += moment_[i] * moment_[i] / (information_[i] * sigma * sigma);
      ++pieces;
    }
    return pieces > kUnknowns ? chi2 / (pieces - kUnknowns) : 1.0;
  }

 private:
  static constexpr int kPieces = 3;
  static constexpr int kUnknowns = 5;  // of an outline: centre, turn, sides
  std::array<double, 4UL * kPieces> information_{}, moment_{};
};

}  // namespace pharos::tof
