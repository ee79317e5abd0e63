// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// Ratio of left to right brightness of the same surface: cameras with automatic exposure differ.
///
/// Patches of the right image are compared with the left one's, and corner detection depends on contrast: the right
/// image must be scaled to the left one's brightness first. Ratios within 8 % of 1 are not corrected.
class ExposureRatio {
 public:
  /// Factor for the right image of this pair, from the pair before; for the first pair from the contrast of the images.
  double of(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) const;
  /// Estimates the ratio for the next pair. `applied`: the factor from of(); features with their positions in both
  /// images, whose pyramids are given.
  void learn(double applied, const std::vector<Feature>& features, const std::vector<PyramidLevel>& left,
             const std::vector<PyramidLevel>& right);

 private:
  std::optional<double> ratio_;
};

}  // namespace pharos::slam
