// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/enhance/smoothness.hpp"

namespace pharos::enhance {

/// One grid of the hierarchy: mass(p) x(p) + sum of link(p, q) (x(p) - x(q)) = right-hand side.
struct SmoothnessGrid {
  std::ptrdiff_t width = 0, height = 0;
  std::vector<float> mass, right, down;
  std::vector<float> along_column, along_row;  ///< inverse pivots of the tridiagonal systems of each column and row
  std::vector<float> x, b, residual;
};

/// Solves (5) by conjugate gradients, preconditioned by one multigrid cycle: lines of both directions as the smoother
/// (links differ by five orders of magnitude, and lines follow the strong ones), 2x2 pixels to one, coarse grids of the
/// same five-point form.
///
/// Stops where the last three steps together moved the solution by less than `tolerance` of its range (RMS). Keeps its
/// memory.
class SmoothnessSolver {
 public:
  /// `refined`: the start value in where it has the size of `start` (else `start` is), the solution out. Returns the
  /// number of iterations.
  int solve(const SmoothnessSystem& system, const FloatImage& start, double tolerance, int most_iterations,
            FloatImage& refined);

 private:
  void build(const SmoothnessSystem& system);
  void cycle(std::size_t level);

  std::vector<SmoothnessGrid> grids_;
  std::vector<float> direction_, image_;
};

}  // namespace pharos::enhance
