// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/camera/pinhole_camera.hpp"

namespace pharos::pointing {

/// A straight piece of an outline in the image, pixels.
struct Segment {
  Vector2 begin = Vector2::Zero();
  Vector2 end = Vector2::Zero();

  double length() const { return (end - begin).norm(); }
  Vector2 along() const { return (end - begin).normalized(); }
  Vector2 across() const {
    const Vector2 d = along();
    return {-d.y(), d.x()};
  }
  Vector2 middle() const { return 0.5 * (begin + end); }
  /// Signed distance of a point from the line.
  double offset(const Vector2& place) const { return across().dot(place - begin); }
  /// Coordinate of a point along it: 0 at the beginning.
  double station(const Vector2& place) const { return along().dot(place - begin); }
};

/// OpenCV's line segment detector (von Gioi 2010). Throws host::InputError where it cannot process the image.
std::vector<Segment> find_segments(ImageView<const std::uint8_t> image);

}  // namespace pharos::pointing
