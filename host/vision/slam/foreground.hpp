// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "host/vision/slam/feature.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Tells a body from the dark around it: pixels brighter (in the mean of 5x5) than the darkest tenth by far more than
/// its noise, in patches larger than any star, with the gaps between them.
class Foreground {
 public:
  Foreground();
  Foreground(Foreground&&) noexcept;
  ~Foreground();
  /// 255 where the body is, 0 elsewhere; holds until the next call.
  ImageView<const std::uint8_t> of(ImageView<const std::uint8_t> image);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// Tells what stands still while the body moves: stars that are as large as patches, struts and housings of one's own
/// craft.
class StaticFeatureFilter {
 public:
  /// Removes features that have stood within 0.7 px for kMinStaticFrames frames, as long as they are the fewer.
  void remove_static(std::vector<Feature>& features);
  int removed() const { return removed_; }

 private:
  struct Seen {
    Vector2 first;  // where its patience began
    Descriptor descriptor;
    int frames;
  };
  std::vector<Seen> seen_;
  int removed_ = 0;
};

}  // namespace pharos::slam
