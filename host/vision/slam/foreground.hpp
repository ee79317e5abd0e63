// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "host/vision/slam/feature.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Separates a lit body from a dark background: pixels brighter (smoothed by 5x5) than the darkest tenth by far more
/// than its noise, in regions larger than any star, including the gaps between them.
class Foreground {
 public:
  Foreground();
  Foreground(Foreground&&) noexcept;
  ~Foreground();
  /// 255 where the body is, 0 elsewhere; valid until the next call.
  ImageView<const std::uint8_t> of(ImageView<const std::uint8_t> image);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// Removes features that are static while the body moves: large stars, struts and housings of the camera's own
/// spacecraft.
class StaticFeatureFilter {
 public:
  /// Removes features that stayed within 0.7 px for kMinStaticFrames frames, as long as they are less than half of all.
  void remove_static(std::vector<Feature>& features);
  int removed() const { return removed_; }

 private:
  struct Seen {
    Vector2 first;  // position when it was first seen
    Descriptor descriptor;
    int frames;
  };
  std::vector<Seen> seen_;
  int removed_ = 0;
};

}  // namespace pharos::slam
