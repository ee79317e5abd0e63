// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tools/evaluation/low_light/published_methods.hpp"

namespace pharos::tools {
namespace {

constexpr double kOmega = 0.8;
constexpr int kWindow_px = 9;

// t below 0.5 is multiplied by 2 t once more, so that dark places do not become noise.
double weighted(double transmission) { return transmission < 0.5 ? 2.0 * transmission * transmission : transmission; }

}  // namespace

// The inverse R of a dark image looks like haze: R = J t + A (1 - t), t = 1 - omega min (R / A) over a window.
GreyBytes dong(const GreyBytes& image, int width_px, int height_px) {
  constexpr double kMinTransmission = 0.01;
  const cv::Mat grey(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(image.data()));
  cv::Mat inverse, darkest;
  cv::subtract(cv::Scalar(255.0), grey, inverse);
  cv::erode(inverse, darkest, cv::getStructuringElement(cv::MORPH_RECT, {kWindow_px, kWindow_px}));
  // Of the 100 pixels that are brightest in all colours the brightest: of one colour, the maximum.
  double brightest = 1.0;
  cv::minMaxLoc(inverse, nullptr, &brightest);
  const double air = std::max(1.0, brightest);
  GreyBytes result;
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double t = std::max(kMinTransmission, 1.0 - kOmega * darkest.at<std::uint8_t>(v, u) / air);
      const double clear = (inverse.at<std::uint8_t>(v, u) - air) / weighted(t) + air;
      result.push_back(cv::saturate_cast<std::uint8_t>(255.0 - clear));
    }
  }
  return result;
}

}  // namespace pharos::tools
