// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/pyramid.hpp"

namespace pharos::slam {

/// An image's pyramid with pixels of its own: some 1 MB for 640 x 480.
class PyramidCopy {
 public:
  PyramidCopy() = default;
  explicit PyramidCopy(const std::vector<PyramidLevel>& from) {
    for (const PyramidLevel& level : from) {
      const ImageView<const std::uint8_t>& image = level.image;
      std::vector<std::uint8_t>& own = pixels_.emplace_back();
      for (std::int32_t v = 0; v < image.height_px; ++v) {
        own.insert(own.end(), image.row(v), image.row(v) + image.width_px);
      }
      levels_.push_back({{own.data(), image.width_px, image.height_px}});
    }
  }
  /// A moved one keeps its pixels where they are.
  PyramidCopy(PyramidCopy&&) = default;
  PyramidCopy& operator=(PyramidCopy&&) = default;
  PyramidCopy(const PyramidCopy&) = delete;
  PyramidCopy& operator=(const PyramidCopy&) = delete;
  ~PyramidCopy() = default;

  const std::vector<PyramidLevel>& levels() const { return levels_; }

 private:
  std::vector<std::vector<std::uint8_t>> pixels_;
  std::vector<PyramidLevel> levels_;
};

}  // namespace pharos::slam
