// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "host/vision/slam/feature.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

struct OrbSettings {
  int features = 1000;
  /// Least difference of light of FAST's circle, grey values of 255: first, and in cells that have none.
  int threshold = 20;
  int min_threshold = 7;
};

/// ORB features of one image: FAST over each pyramid level and once more, for faint corners, in cells that have none;
/// spread by a quadtree; orientation and descriptor as Rublee 2011 (OpenCV's). Their places are whole pixels of their
/// levels.
///
/// Keeps its memory; one a camera, not for two threads at once.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbSettings& settings);
  OrbExtractor(OrbExtractor&&) noexcept;
  ~OrbExtractor();

  /// `mask`: 0 where no feature may be; empty for everywhere. Stereo fields are left empty.
  const std::vector<Feature>& extract(ImageView<const std::uint8_t> image, ImageView<const std::uint8_t> mask);
  /// What extract() returned last.
  const std::vector<Feature>& features() const;
  /// Of the image extracted last.
  const std::vector<PyramidLevel>& pyramid() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pharos::slam
