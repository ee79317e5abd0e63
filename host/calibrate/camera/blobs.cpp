// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/blobs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace pharos::calibrate {
namespace {

// A threshold between the levels of sheet and dots, whether the dots cover a twentieth or a half of the sheet.
constexpr double kThresholdDeviations = 0.75;
// A window that holds part of a board deviates by far more than noise.
constexpr double kMinContrast = 4.0;
constexpr double kMinArea_px = 6.0;
constexpr double kLargestFraction = 0.02;  // of the image
// Area over that of the ellipse with the same moments; 1 for an ellipse, a square has 0.95, a cross of dots 0.6.
constexpr double kMinFill = 0.85;
constexpr double kMaxElongated = 5.0;

// Noise of a pixel, 1 sigma, from the median difference of second neighbours: edges are few.
double noise_of(GreyView image) {
  std::vector<int> differences;
  differences.reserve(image.pixels());
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 2; u < image.width_px; ++u) {
      differences.push_back(std::abs(int{image.at(u, v)} - 2 * int{image.at(u - 1, v)} + int{image.at(u - 2, v)}));
    }
  }
  if (differences.empty()) return 0.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return std::max(*middle / (0.6745 * std::sqrt(6.0)), 0.5);  // half a count: quantisation
}

// 1 where a pixel is beyond the threshold of its window.
cv::Mat mask_of(GreyView image, int window_px, bool bright) {
  const cv::Mat grey(image.height_px, image.width_px, CV_16U, const_cast<std::uint16_t*>(image.data),
                     sizeof(std::uint16_t) * static_cast<std::size_t>(image.stride_px));
  cv::Mat sums, squares, mask(grey.size(), CV_8U);
  cv::integral(grey, sums, squares, CV_64F, CV_64F);
  const double min_deviation = kMinContrast * noise_of(image);
  const int reach = window_px / 2;
  for (int v = 0; v < grey.rows; ++v) {
    const int top = std::max(v - reach, 0), bottom = std::min(v + reach + 1, grey.rows);
    for (int u = 0; u < grey.cols; ++u) {
      const int left = std::max(u - reach, 0), right = std::min(u + reach + 1, grey.cols);
      const auto sum = [&](const cv::Mat& of) {
        const double *upper = of.ptr<double>(top), *lower = of.ptr<double>(bottom);
        return lower[right] - lower[left] - upper[right] + upper[left];
      };
      const double count = static_cast<double>(right - left) * (bottom - top), mean = sum(sums) / count;
      const double deviation = std::sqrt(std::max(sum(squares) / count - mean * mean, 0.0));
      const double above = bright ? image.at(u, v) - mean : mean - image.at(u, v);
      mask.at<std::uint8_t>(v, u) = deviation > min_deviation && above > kThresholdDeviations * deviation ? 1 : 0;
    }
  }
  return mask;
}

// 1 where a pixel is beyond Otsu's threshold.
cv::Mat otsu_mask_of(GreyView image, bool bright) {
  const cv::Mat grey(image.height_px, image.width_px, CV_16U, const_cast<std::uint16_t*>(image.data),
                     sizeof(std::uint16_t) * static_cast<std::size_t>(image.stride_px));
  cv::Mat smooth, bytes, mask;
  cv::GaussianBlur(grey, smooth, {5, 5}, 0.0);
  cv::normalize(smooth, bytes, 0.0, 255.0, cv::NORM_MINMAX, CV_8U);
  cv::threshold(bytes, mask, 0.0, 1.0, (bright ? cv::THRESH_BINARY : cv::THRESH_BINARY_INV) | cv::THRESH_OTSU);
  return mask;
}

struct Moments {
  double area = 0.0;
  Vector2 sum = Vector2::Zero();
  Matrix2 squares = Matrix2::Zero();
  bool cut = false;
};

// Connected components of the mask (four neighbours); the first is the background.
std::vector<Moments> regions_of(const cv::Mat& mask) {
  cv::Mat labels;
  std::vector<Moments> regions(static_cast<std::size_t>(cv::connectedComponents(mask, labels, 4, CV_32S)));
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const int label = labels.at<int>(v, u);
      if (label == 0) continue;
      Moments& region = regions[static_cast<std::size_t>(label)];
      const Vector2 pixel(u, v);
      region.area += 1.0;
      region.sum += pixel;
      region.squares += pixel * pixel.transpose();
      region.cut = region.cut || u == 0 || v == 0 || u + 1 == mask.cols || v + 1 == mask.rows;
    }
  }
  return regions;
}

bool is_elliptic(const Blob& blob, double area) {
  const double trace = blob.covariance_px2.trace(), determinant = blob.covariance_px2.determinant();
  if (determinant <= 0.0) return false;
  const double ellipse = 4.0 * std::numbers::pi * std::sqrt(determinant);
  const double spread = std::sqrt(std::max(0.25 * trace * trace - determinant, 0.0));
  const double axes = std::sqrt((0.5 * trace + spread) / std::max(0.5 * trace - spread, 1e-9));
  return area > kMinFill * ellipse && axes < kMaxElongated;
}

std::vector<Blob> blobs_of(const cv::Mat& mask) {
  const double largest = kLargestFraction * static_cast<double>(mask.total());
  std::vector<Blob> blobs;
  for (const Moments& moments : regions_of(mask)) {
    if (moments.area < kMinArea_px || moments.area > largest) continue;
    Blob blob;
    blob.cut = moments.cut;
    blob.centre_px = moments.sum / moments.area;
    blob.covariance_px2 = moments.squares / moments.area - blob.centre_px * blob.centre_px.transpose() +
                          Matrix2::Identity() / 12.0;  // of the pixels themselves
    if (blob.cut || is_elliptic(blob, moments.area)) blobs.push_back(blob);
  }
  return blobs;
}

}  // namespace

double Blob::area_px() const { return 4.0 * std::numbers::pi * std::sqrt(covariance_px2.determinant()); }

std::vector<Blob> find_blobs(GreyView image, int window_px, bool bright) {
  return blobs_of(mask_of(image, window_px, bright));
}

std::vector<Blob> find_blobs_by_otsu(GreyView image, bool bright) { return blobs_of(otsu_mask_of(image, bright)); }

}  // namespace pharos::calibrate
