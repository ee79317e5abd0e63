// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

using KeyframeId = std::int64_t;
using PointId = std::int64_t;
inline constexpr std::int64_t kNone = -1;

/// Grid of features by position, for neighbourhood queries.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const std::vector<Feature>& features, std::int32_t width_px, std::int32_t height_px);
  /// Numbers of features within `radius_px` in u and in v, of levels `least` to `most`.
  void near(const std::vector<Feature>& features, const Vector2& pixel, double radius_px, int minimum, int maximum,
            std::vector<int>& found) const;

 private:
  static constexpr double kCell_px = 32.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

/// A stereo pair as features, and the map points that they match.
struct Frame {
  std::int64_t number = 0;  ///< of the pair, from 0
  double time_s = 0.0;
  std::vector<Feature> features;
  FeatureGrid grid;
  std::vector<PointId> points;  ///< of the map, a feature each; kNone
  CameraFromTarget pose;
  /// Variance of the residuals of aligned patches over that assumed of them, at least 1; robust, outliers included.
  double variance_factor = 1.0;
};

}  // namespace pharos::slam
