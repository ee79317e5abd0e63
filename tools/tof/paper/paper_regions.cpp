// SPDX-License-Identifier: Apache-2.0
// Section 2.2.2 of paper 000: connectors by a local threshold and region growing.
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tools/tof/paper/paper_chain.hpp"

namespace pharos::tools::paper000 {
namespace {

// As printed.
constexpr int kHalfWindow = 4;
constexpr double kDeviations = 0.2;
constexpr double kMinArea_px = 20.0, kMaxAreaOfRing = 0.1;
constexpr double kMinAspect = 0.7, kMaxAspect = 1.5;
constexpr double kMinFilling = 0.7;

// (5): the sum of squares under the root over the mean as printed, or over the number of pixels.
std::vector<std::uint8_t> above_threshold(const ChainStages& stages, bool printed) {
  const cv::Mat grey(stages.height_px, stages.width_px, CV_8U, const_cast<std::uint8_t*>(stages.grey.data()));
  constexpr int kWindow = 2 * kHalfWindow + 1;
  cv::Mat values, mean, squares;
  grey.convertTo(values, CV_64F);
  cv::boxFilter(values, mean, CV_64F, {kWindow, kWindow}, {-1, -1}, true, cv::BORDER_REFLECT_101);
  cv::boxFilter(values.mul(values), squares, CV_64F, {kWindow, kWindow}, {-1, -1}, true, cv::BORDER_REFLECT_101);
  std::vector<std::uint8_t> above(stages.grey.size());
  for (int v = 0; v < grey.rows; ++v) {
    for (int u = 0; u < grey.cols; ++u) {
      const double m = mean.at<double>(v, u);
      const double sum = kWindow * kWindow * std::max(0.0, squares.at<double>(v, u) - m * m);
      const double over = printed ? m : kWindow * kWindow;
      const double threshold = m - (over > 0.0 ? kDeviations * std::sqrt(sum / over) : 0.0);
      const double value = grey.at<std::uint8_t>(v, u);
      above[static_cast<std::size_t>(v * grey.cols + u)] = value > 0.0 && value > threshold ? 255 : 0;
    }
  }
  return above;
}

cv::RotatedRect box_of(const Region& region) {
  std::vector<cv::Point> points;
  for (const auto& [u, v] : region.pixels) points.emplace_back(u, v);
  cv::RotatedRect box = cv::minAreaRect(points);
  box.size.width += 1.0F;  // from the pixels' outer borders
  box.size.height += 1.0F;
  return box;
}

template <class Rule>
std::vector<Region> kept(const std::vector<Region>& regions, Rule&& rule) {
  std::vector<Region> result;
  std::copy_if(regions.begin(), regions.end(), std::back_inserter(result), rule);
  return result;
}

}  // namespace

void find_connectors(ChainStages& stages, const ChainSettings& settings) {
  if (!stages.ring) return;
  stages.above = above_threshold(stages, settings.printed_threshold);
  const cv::Mat above(stages.height_px, stages.width_px, CV_8U, stages.above.data());
  // Burrs and single points.
  cv::Mat clean, labels;
  cv::morphologyEx(above, clean, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  const int count = cv::connectedComponents(clean, labels, 4, CV_32S);
  std::vector<Region> regions(static_cast<std::size_t>(std::max(0, count - 1)));
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      const int label = labels.at<int>(v, u);
      if (label > 0) regions[static_cast<std::size_t>(label - 1)].pixels.push_back({u, v});
    }
  }
  for (Region& region : regions) {
    for (const auto& [u, v] : region.pixels) {
      region.middle_px += Vector2(u, v) / static_cast<double>(region.pixels.size());
    }
  }
  const PaperEllipse& outer = (*stages.ring)[0];
  const double max_area = kMaxAreaOfRing * std::numbers::pi * outer.a_px * outer.b_px;
  stages.regions[0] = regions;
  stages.regions[1] = kept(stages.regions[0], [&](const Region& region) {
    const auto area = static_cast<double>(region.pixels.size());
    return area >= kMinArea_px && area <= max_area;
  });
  stages.regions[2] = kept(stages.regions[1], [](const Region& region) {
    const cv::RotatedRect box = box_of(region);
    const double aspect = static_cast<double>(box.size.width) / static_cast<double>(box.size.height);
    return aspect >= kMinAspect && aspect <= kMaxAspect;
  });
  stages.regions[3] = kept(stages.regions[2], [](const Region& region) {
    return static_cast<double>(region.pixels.size()) >= kMinFilling * static_cast<double>(box_of(region).size.area());
  });
}

}  // namespace pharos::tools::paper000
