// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/support/input_error.hpp"
#include "host/vision/pointing/segment.hpp"

namespace pharos::pointing {
namespace {

// A satellite's outline has some dozens.
constexpr std::size_t kMaxSegments = 4096;
// OpenCV's default scale, and the smallest for larger images: its time is proportional to the pixels, all of which it
// sorts. Edges are then found to a pixel, and refitted on the grey image anyway.
constexpr double kUsualScale = 0.8;
constexpr double kMinScale = 0.4;
constexpr double kMaxPixels = 80'000.0;  // after scaling: panels of 300 px are not reduced

double scale_for(ImageView<const std::uint8_t> image) {
  return std::clamp(std::sqrt(kMaxPixels / static_cast<double>(image.pixels())), kMinScale, kUsualScale);
}

}  // namespace

std::vector<Segment> find_segments(ImageView<const std::uint8_t> image) try {
  const cv::Mat grey(image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data));
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD, scale_for(image))->detect(grey, found);
  found.resize(std::min(found.size(), kMaxSegments));
  std::vector<Segment> segments;
  for (const cv::Vec4d segment : found) segments.push_back({{segment[0], segment[1]}, {segment[2], segment[3]}});
  return segments;
} catch (const cv::Exception&) {
  throw host::InputError("OpenCV's line segment detector failed on an image of " + std::to_string(image.width_px) +
                         " x " + std::to_string(image.height_px));
}

}  // namespace pharos::pointing
