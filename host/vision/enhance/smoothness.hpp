// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/enhance/enhancer.hpp"

namespace pharos::enhance {

/// The epsilon of (5) and (6), 1 = white: a smaller difference of two neighbours counts as none.
inline constexpr float kFlat = 1e-3F;

/// (5) as a system of linear equations: for each pixel p, L(p) + sum over its four neighbours q of
/// link(p, q) (L(p) - L(q)) = start(p). Symmetric and positive definite. Rows without gaps.
struct SmoothnessSystem {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<float> right;  ///< link to the neighbour on the right; 0 in the last column
  std::vector<float> down;   ///< link to the neighbour below; 0 in the last row
};

/// max over the channels (2); one plane.
void max_of_channels(const FloatImage& frame, FloatImage& start);

/// Links of (5): alpha W / (|difference| + eps), W by the strategy, (6) for kWindow with a window of 3 sigma to each
/// side.
class SmoothnessWeights {
 public:
  void weigh(const FloatImage& start, WeightStrategy strategy, double alpha, double sigma_px, SmoothnessSystem& system);

 private:
  std::vector<float> across_, gathered_;
};

}  // namespace pharos::enhance
