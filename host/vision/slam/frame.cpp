// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/frame.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::slam {

FeatureGrid::FeatureGrid(const std::vector<Feature>& features, std::int32_t width_px, std::int32_t height_px)
    : columns_(static_cast<int>(width_px / kCell_px) + 1), rows_(static_cast<int>(height_px / kCell_px) + 1) {
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t k = 0; k < features.size(); ++k) {
    const int c = std::clamp(static_cast<int>(features[k].pixel.x() / kCell_px), 0, columns_ - 1);
    const int r = std::clamp(static_cast<int>(features[k].pixel.y() / kCell_px), 0, rows_ - 1);
    cells_[static_cast<std::size_t>(r * columns_ + c)].push_back(static_cast<int>(k));
  }
}

void FeatureGrid::near(const std::vector<Feature>& features, const Vector2& pixel, double radius_px, int minimum,
                       int maximum, std::vector<int>& found) const {
  found.clear();
  const int first_c = std::max(0, static_cast<int>(std::floor((pixel.x() - radius_px) / kCell_px)));
  const int last_c = std::min(columns_ - 1, static_cast<int>(std::floor((pixel.x() + radius_px) / kCell_px)));
  const int first_r = std::max(0, static_cast<int>(std::floor((pixel.y() - radius_px) / kCell_px)));
  const int last_r = std::min(rows_ - 1, static_cast<int>(std::floor((pixel.y() + radius_px) / kCell_px)));
  for (int r = first_r; r <= last_r; ++r) {
    for (int c = first_c; c <= last_c; ++c) {
      for (const int k : cells_[static_cast<std::size_t>(r * columns_ + c)]) {
        const Feature& feature = features[static_cast<std::size_t>(k)];
        if (feature.level < minimum || feature.level > maximum) continue;
        if ((feature.pixel - pixel).cwiseAbs().maxCoeff() <= radius_px) found.push_back(k);
      }
    }
  }
}

}  // namespace pharos::slam
