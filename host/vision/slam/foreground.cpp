// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/foreground.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace pharos::slam {
namespace {

constexpr int kMean_px = 5;
constexpr double kMinStep = 2.0;     // grey values above the background
constexpr double kNoiseTimes = 8.0;  // of the background's noise
constexpr int kMinArea_px = 200;     // a star smoothed by 5x5 has 25
constexpr double kShareOfLargest = 0.02;
constexpr int kGap_px = 15;  // largest gap between lit parts of a body
constexpr int kMargin_px = 2;

constexpr int kMinStaticFrames = 10;  // frames
constexpr double kStatic_px = 0.7;
constexpr int kAlike = 40;

// Level above which a pixel of the smoothed image belongs to the body.
double dark_limit(const cv::Mat& mean) {
  std::array<int, 256> histogram{};
  for (int v = 0; v < mean.rows; ++v) {
    const std::uint8_t* row = mean.ptr<std::uint8_t>(v);
    for (int u = 0; u < mean.cols; ++u) ++histogram[row[u]];
  }
  const auto quantile = [&](double fraction) {
    double left = fraction * static_cast<double>(mean.total());
    for (std::size_t value = 0; value < histogram.size(); ++value) {
      left -= histogram[value];
      if (left < 0.0) return static_cast<double>(value);
    }
    return 255.0;
  };
  const double middle = quantile(0.05), spread = 0.78 * (quantile(0.1) - quantile(0.01));
  return middle + std::max(kMinStep, kNoiseTimes * spread);
}

}  // namespace

struct Foreground::Work {
  cv::Mat mean, lit, labels, stats, centres, mask;
};

Foreground::Foreground() : work_(std::make_unique<Work>()) {}
Foreground::Foreground(Foreground&&) noexcept = default;
Foreground::~Foreground() = default;

ImageView<const std::uint8_t> Foreground::of(ImageView<const std::uint8_t> image) {
  Work& work = *work_;
  const cv::Mat mat(image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data),
                    static_cast<std::size_t>(image.stride_px));
  cv::blur(mat, work.mean, {kMean_px, kMean_px});
  cv::threshold(work.mean, work.lit, dark_limit(work.mean), 255.0, cv::THRESH_BINARY);
  const int count = cv::connectedComponentsWithStats(work.lit, work.labels, work.stats, work.centres);
  int largest = 0;
  for (int k = 1; k < count; ++k) largest = std::max(largest, work.stats.at<int>(k, cv::CC_STAT_AREA));
  const double minimum = std::max<double>(kMinArea_px, kShareOfLargest * largest);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(count), 0);
  for (int k = 1; k < count; ++k) {
    keep[static_cast<std::size_t>(k)] = work.stats.at<int>(k, cv::CC_STAT_AREA) >= minimum ? 255 : 0;
  }
  work.mask.create(mat.size(), CV_8U);
  for (int v = 0; v < mat.rows; ++v) {
    const int* label = work.labels.ptr<int>(v);
    std::uint8_t* out = work.mask.ptr<std::uint8_t>(v);
    for (int u = 0; u < mat.cols; ++u) out[u] = keep[static_cast<std::size_t>(label[u])];
  }
  const auto square = [](int side) { return cv::getStructuringElement(cv::MORPH_RECT, {side, side}); };
  cv::morphologyEx(work.mask, work.mask, cv::MORPH_CLOSE, square(kGap_px));
  cv::dilate(work.mask, work.mask, square(2 * kMargin_px + 1));
  return {work.mask.data, work.mask.cols, work.mask.rows, static_cast<std::int32_t>(work.mask.step[0])};
}

void StaticFeatureFilter::remove_static(std::vector<Feature>& features) {
  std::vector<Seen> now;
  std::vector<bool> still(features.size(), false);
  std::size_t count = 0;
  // Sorted by the row of the first position, so that the search for neighbours is short.
  std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) { return a.first.y() < b.first.y(); });
  for (std::size_t k = 0; k < features.size(); ++k) {
    const Feature& feature = features[k];
    Seen seen{feature.pixel, feature.descriptor, 1};
    auto at = std::lower_bound(seen_.begin(), seen_.end(), feature.pixel.y() - kStatic_px,
                               [](const Seen& old, double v) { return old.first.y() < v; });
    for (; at != seen_.end() && at->first.y() <= feature.pixel.y() + kStatic_px; ++at) {
      if ((at->first - feature.pixel).norm() <= kStatic_px && at->frames >= seen.frames &&
          distance(at->descriptor, feature.descriptor) <= kAlike) {
        seen = {at->first, feature.descriptor, at->frames + 1};
      }
    }
    now.push_back(seen);
    still[k] = seen.frames > kMinStaticFrames;
    count += still[k] ? 1U : 0U;
  }
  seen_ = std::move(now);
  removed_ = 0;
  if (2 * count >= features.size()) return;  // the static features are those of the body itself
  std::vector<Feature> kept;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (!still[k]) kept.push_back(features[k]);
  }
  removed_ = static_cast<int>(features.size() - kept.size());
  features = std::move(kept);
}

}  // namespace pharos::slam
