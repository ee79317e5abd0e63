// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Where a level of an image may have features: from the image's mask (0: none); without a mask everywhere.
class LevelMask {
 public:
  LevelMask(ImageView<const std::uint8_t> mask, const cv::Mat& image, const cv::Mat& level)
      : mask_(mask),
        scale_u_(static_cast<float>(image.cols) / static_cast<float>(level.cols)),
        scale_v_(static_cast<float>(image.rows) / static_cast<float>(level.rows)) {}
  bool at(float u, float v) const {
    if (mask_.empty()) return true;
    const auto mu = static_cast<std::int32_t>(u * scale_u_), mv = static_cast<std::int32_t>(v * scale_v_);
    return mask_.contains(mu, mv) && mask_.at(mu, mv) != 0;
  }
  // Sampling every fourth pixel suffices: masked regions have no smaller parts.
  bool any(const cv::Rect& cell) const {
    for (int v = cell.y; v < cell.y + cell.height; v += 4) {
      for (int u = cell.x; u < cell.x + cell.width; u += 4) {
        if (at(static_cast<float>(u), static_cast<float>(v))) return true;
      }
    }
    return false;
  }

 private:
  ImageView<const std::uint8_t> mask_;
  float scale_u_, scale_v_;
};

}  // namespace pharos::slam
