// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "host/vision/slam/feature.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

struct OrbSettings {
  int features = 1000;
  /// FAST thresholds, grey values of 255: the first one, and that for cells without corners.
  int threshold = 20;
  int min_threshold = 7;
};

/// ORB features of one image: FAST over each pyramid level and once more, for faint corners, in cells that have none;
/// distributed by a quadtree; orientation and descriptor as Rublee 2011 (OpenCV's). Their positions are whole pixels of
/// their levels.
///
/// Reuses its buffers; one instance a camera, not thread-safe.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbSettings& settings);
  OrbExtractor(OrbExtractor&&) noexcept;
  ~OrbExtractor();

  /// `mask`: 0 where no feature may be; empty: no mask. Stereo fields are left empty.
  const std::vector<Feature>& extract(ImageView<const std::uint8_t> image, ImageView<const std::uint8_t> mask);
  /// The last result of extract().
  const std::vector<Feature>& features() const;
  /// Pyramid of the last image.
  const std::vector<PyramidLevel>& pyramid() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pharos::slam
