// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "host/support/input_error.hpp"
#include "host/support/module_function.hpp"
#include "host/vision/pointing/lsd_module.hpp"
#include "host/vision/pointing/segment.hpp"

namespace pharos::pointing {
namespace {

// A satellite's outline has some dozens.
constexpr int kMaxSegments = 4096;
// OpenCV's own scale, and what larger images are looked at with: its time goes by pixels, of which it sorts all. Edges
// are then found to a pixel, and refitted on the grey image anyway.
constexpr double kUsualScale = 0.8;
constexpr double kMinScale = 0.4;
constexpr double kMaxPixels = 80'000.0;  // after scaling: panels of 300 px are looked at as they are

double scale_for(ImageView<const std::uint8_t> image) {
  return std::clamp(std::sqrt(kMaxPixels / static_cast<double>(image.pixels())), kMinScale, kUsualScale);
}

LsdFunction detector() {
  static const auto function = reinterpret_cast<LsdFunction>(host::module_function(kLsdModuleName, kLsdModuleFunction));
  return function;
}

}  // namespace

std::vector<Segment> find_segments(ImageView<const std::uint8_t> image) {
  std::vector<float> numbers(std::size_t{4} * kMaxSegments);
  const int count =
      detector()(image.data, image.width_px, image.height_px, scale_for(image), numbers.data(), kMaxSegments);
  if (count < 0)
    throw host::InputError("OpenCV's line segment detector failed on an image of " + std::to_string(image.width_px) +
                           " x " + std::to_string(image.height_px));
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < 4U * static_cast<std::size_t>(count); i += 4) {
    const auto at = [&](std::size_t k) { return static_cast<double>(numbers[i + k]); };
    segments.push_back({{at(0), at(1)}, {at(2), at(3)}});
  }
  return segments;
}

}  // namespace pharos::pointing
