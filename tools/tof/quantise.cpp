// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/quantise.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/camera/depth_camera.hpp"

namespace pharos::tools {

void quantise_depth(std::span<std::uint16_t> depth, int bits) {
  std::uint16_t nearest = kNoDepthHigh;
  std::uint16_t farthest = kNoDepthLow;
  for (const std::uint16_t counts : depth) {
    if (!has_depth(counts)) continue;
    nearest = std::min(nearest, counts);
    farthest = std::max(farthest, counts);
  }
  if (nearest >= farthest) return;
  const double step = (farthest - nearest) / (std::exp2(bits) - 1.0);
  for (std::uint16_t& counts : depth) {
    if (!has_depth(counts)) continue;
    counts = static_cast<std::uint16_t>(nearest + step * std::round((counts - nearest) / step) + 0.5);
  }
}

}  // namespace pharos::tools
