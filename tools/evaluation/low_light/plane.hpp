// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/low_light/low_light_peers.hpp"

namespace pharos::tools {

/// One plane of numbers, row by row without gaps.
struct Plane {
  int width_px = 0, height_px = 0;
  std::vector<double> values;

  Plane(int width, int height, double value = 0.0)
      : width_px(width),
        height_px(height),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(u);
  }
  double& at(int u, int v) { return values[index(u, v)]; }
  double at(int u, int v) const { return values[index(u, v)]; }
};

/// 0 ... 1 of 8 bits, and back: clipped, rounded.
Plane plane_of(const GreyBytes& image, int width_px, int height_px);
GreyBytes bytes_of(const Plane& plane);

/// Differences to the right and down; 0 in the last column and row.
struct Gradient {
  Plane right, down;
};
Gradient gradient_of(const Plane& plane);

struct SolverLimits {
  double residual = 1e-4;  ///< of the right side
  int iterations = 100;
};

/// The minimum over x of sum (x - data)^2 + sum weights (gradient x)^2, by conjugate gradients (scaled by the diagonal)
/// from `start`.
Plane smoothest(const Plane& data, const Gradient& weights, const Plane& start, const SolverLimits& limits = {});

}  // namespace pharos::tools
