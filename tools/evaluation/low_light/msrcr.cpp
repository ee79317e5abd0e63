// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tools/evaluation/low_light/published_methods.hpp"

namespace pharos::tools {

// R = G (C sum w (log I - log (F * I)) + b), C = beta log(alpha I / sum of the colours). Of equal colours C is one
// number, and gain and offset are taken as the range of display: 1 to 99 % of the values.
GreyBytes msrcr(const GreyBytes& image, int width_px, int height_px) {
  constexpr std::array<double, 3> kScales_px = {15.0, 80.0, 250.0};
  constexpr double kAlpha = 125.0, kBeta = 46.0, kColours = 3.0;
  constexpr double kClipped = 0.01;
  const cv::Mat grey(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(image.data()));
  cv::Mat light, own, sum = cv::Mat::zeros(grey.size(), CV_64F);
  grey.convertTo(light, CV_64F, 1.0, 1.0);  // log of 0
  cv::log(light, own);
  for (const double scale : kScales_px) {
    cv::Mat around;
    cv::GaussianBlur(light, around, {}, scale);
    cv::log(around, around);
    sum += (own - around) / static_cast<double>(kScales_px.size());
  }
  sum *= kBeta * std::log(kAlpha / kColours);
  std::vector<double> sorted(sum.begin<double>(), sum.end<double>());
  std::sort(sorted.begin(), sorted.end());
  const auto clipped = static_cast<std::size_t>(kClipped * static_cast<double>(sorted.size()));
  const double low = sorted[clipped], high = std::max(low + 1e-6, sorted[sorted.size() - 1 - clipped]);
  cv::Mat result;
  sum.convertTo(result, CV_8U, 255.0 / (high - low), -255.0 * low / (high - low));
  return {result.begin<std::uint8_t>(), result.end<std::uint8_t>()};
}

}  // namespace pharos::tools
