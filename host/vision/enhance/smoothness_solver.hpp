// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/enhance/smoothness_grid.hpp"

namespace pharos::enhance {

/// Solves (5) by conjugate gradients, preconditioned by one multigrid cycle: lines of both directions as the smoother
/// (links differ by five orders of magnitude, and lines follow the strong ones), 2x2 pixels to one, coarse grids of the
/// same five-point form.
///
/// Stops where the solution is off by less than `tolerance` of its range (RMS), a quarter of it as steps tell. Keeps
/// its memory.
class SmoothnessSolver {
 public:
  /// `refined`: the start value in where it has the size of `start` (else `start` is), the solution out. Returns the
  /// number of iterations.
  int solve(const SmoothnessSystem& system, const FloatImage& start, double tolerance, int max_iterations,
            FloatImage& refined);

 private:
  void cycle(std::size_t level);

  std::vector<SmoothnessGrid> grids_;
  std::vector<float> direction_, image_;
};

}  // namespace pharos::enhance
