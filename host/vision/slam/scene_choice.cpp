// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/scene_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace pharos::slam {
namespace {

constexpr int kSmoothed_px = 5;
constexpr int kOutline_px = 8;
constexpr double kMinDarkStep = 2.0;     // grey values: quantisation, slow changes of a sensor's black level
constexpr double kDarkNoiseTimes = 8.0;  // of the smoothed image's noise
constexpr double kMinDarkFraction = 0.5;

int level_below(const cv::Mat& mean, double fraction) {
  std::array<int, 256> histogram{};
  for (int v = 0; v < mean.rows; ++v) {
    const std::uint8_t* row = mean.ptr<std::uint8_t>(v);
    for (int u = 0; u < mean.cols; ++u) ++histogram[row[u]];
  }
  double left = fraction * static_cast<double>(mean.total());
  int value = 0;
  for (; value < 255; ++value) {
    left -= histogram[static_cast<std::size_t>(value)];
    if (left < 0.0) break;
  }
  return value;
}

// Standard deviation of single pixels about their mean, of those whose mean is at most `limit`; from absolute
// differences, which a star among them hardly changes.
double dark_noise(const cv::Mat& image, const cv::Mat& mean, int limit) {
  double sum = 0.0, count = 0.0;
  for (int v = 0; v < image.rows; ++v) {
    const std::uint8_t* pixel = image.ptr<std::uint8_t>(v);
    const std::uint8_t* smooth = mean.ptr<std::uint8_t>(v);
    for (int u = 0; u < image.cols; ++u) {
      if (smooth[u] > limit) continue;
      sum += std::abs(pixel[u] - smooth[u]);
      count += 1.0;
    }
  }
  return count > 0.0 ? 1.25 * sum / count : 0.0;
}

}  // namespace

double dark_outline(ImageView<const std::uint8_t> view) {
  const cv::Mat image(view.height_px, view.width_px, CV_8U, const_cast<std::uint8_t*>(view.data),
                      static_cast<std::size_t>(view.stride_px));
  cv::Mat mean;
  cv::blur(image, mean, {kSmoothed_px, kSmoothed_px});
  const double noise = dark_noise(image, mean, level_below(mean, 0.1)) / kSmoothed_px;
  const double limit = level_below(mean, 0.05) + std::max(kMinDarkStep, kDarkNoiseTimes * noise);
  double dark = 0.0, count = 0.0;
  for (int v = 0; v < mean.rows; ++v) {
    const bool across = v < kOutline_px || v >= mean.rows - kOutline_px;
    const std::uint8_t* row = mean.ptr<std::uint8_t>(v);
    for (int u = 0; u < mean.cols; ++u) {
      if (!across && u >= kOutline_px && u < mean.cols - kOutline_px) continue;
      dark += row[u] <= limit ? 1.0 : 0.0;
      count += 1.0;
    }
  }
  return count > 0.0 ? dark / count : 0.0;
}

Scene scene_of(ImageView<const std::uint8_t> image) {
  return dark_outline(image) > kMinDarkFraction ? Scene::kTarget : Scene::kStatic;
}

}  // namespace pharos::slam
