// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// How much brighter the left camera tells what both see: cameras that choose their exposures by themselves differ.
///
/// Squares of the right image are compared with the left one's, corners are found by differences of light: the right
/// image must be brought to the left one's light first. Cameras that agree to 8 % are left alone.
class ExposureRatio {
 public:
  /// Factor for the right image of this pair, from the pair before; of a first pair from the contrast of the images.
  double of(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) const;
  /// `applied`: what of() gave; features with their places in both images, whose pyramids are given.
  void learn(double applied, const std::vector<Feature>& features, const std::vector<PyramidLevel>& left,
             const std::vector<PyramidLevel>& right);

 private:
  std::optional<double> ratio_;
};

}  // namespace pharos::slam
