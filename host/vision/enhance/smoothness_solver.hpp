// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/enhance/smoothness_grid.hpp"

namespace pharos::enhance {

/// Solves (5) by conjugate gradients, preconditioned by one multigrid cycle: line sweeps in both directions as the
/// smoother (links differ by five orders of magnitude, and lines follow the strong ones), 2x2 pixels to one, coarse
/// grids of the same five-point form.
///
/// Stops where the error of the solution is below `tolerance` times its range (RMS): the estimate from the steps must
/// be below a quarter of it. Reuses its buffers.
class SmoothnessSolver {
 public:
  /// `refined`: in, the start value if it has the size of `start` (else `start` is used); out, the solution. Returns
  /// the number of iterations.
  int solve(const SmoothnessSystem& system, const FloatImage& start, double tolerance, int max_iterations,
            FloatImage& refined);

 private:
  void cycle(std::size_t level);

  std::vector<SmoothnessGrid> grids_;
  std::vector<float> direction_, image_;
};

}  // namespace pharos::enhance
