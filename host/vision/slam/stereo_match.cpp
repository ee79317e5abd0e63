// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/stereo_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "host/vision/slam/square_shift.hpp"

namespace pharos::slam {
namespace {

constexpr int kShift_px = 5;  // searched to each side of the right feature
constexpr int kBestMatches = (kLowDistanceThreshold + kHighDistanceThreshold) / 2;
constexpr double kMinDisparity_px = 0.3;

// Right features by the rows in which they may match.
class Rows {
 public:
  Rows(const std::vector<Feature>& right, std::int32_t height_px, double reach)
      : rows_(static_cast<std::size_t>(height_px)) {
    for (std::size_t k = 0; k < right.size(); ++k) {
      const double half = reach * scale_of(right[k].level);
      const int first = std::max(0, static_cast<int>(std::ceil(right[k].pixel.y() - half)));
      const int last = std::min(height_px - 1, static_cast<int>(std::floor(right[k].pixel.y() + half)));
      for (int v = first; v <= last; ++v) rows_[static_cast<std::size_t>(v)].push_back(static_cast<int>(k));
    }
  }
  const std::vector<int>& at(double v) const {
    const auto row = std::clamp(std::lround(v), 0L, static_cast<long>(rows_.size()) - 1);
    return rows_[static_cast<std::size_t>(row)];
  }

 private:
  std::vector<std::vector<int>> rows_;
};

struct BestMatch {
  int index = -1;
  int distance = kBestMatches;
};

BestMatch best_match(const Feature& feature, const std::vector<Feature>& right, const std::vector<int>& candidates,
                     double first_u, double last_u) {
  BestMatch best;
  for (const int k : candidates) {
    const Feature& other = right[static_cast<std::size_t>(k)];
    if (std::abs(other.level - feature.level) > 1 || other.pixel.x() < first_u || other.pixel.x() > last_u) continue;
    const int d = distance(feature.descriptor, other.descriptor);
    if (d < best.distance) best = {k, d};
  }
  return best;
}

// Sum of absolute differences of two squares, each relative to its central pixel, because brightness differs between
// the cameras.
int difference(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v, int right_u) {
  const int offset = left.at(u, v) - right.at(right_u, v);
  int sum = 0;
  for (int dv = -kSquareRadius_px; dv <= kSquareRadius_px; ++dv) {
    const std::uint8_t* a = left.row(v + dv) + u;
    const std::uint8_t* b = right.row(v + dv) + right_u;
    for (int du = -kSquareRadius_px; du <= kSquareRadius_px; ++du) sum += std::abs(a[du] - b[du] - offset);
  }
  return sum;
}

struct SubPixel {
  double right_u_px = -1.0;
  Vector2 slope = Vector2::Zero();  // of the disparity
  int difference = 0;
};

// The right column of a left feature, refined on the feature's level. Below 0 without a clear minimum in the interior.
SubPixel refine(const Feature& feature, double right_u, const std::vector<PyramidLevel>& left_pyramid,
                const std::vector<PyramidLevel>& right_pyramid) {
  const auto level = static_cast<std::size_t>(feature.level);
  const ImageView<const std::uint8_t> left = left_pyramid[level].image, right = right_pyramid[level].image;
  const LevelPlaces places(left_pyramid, feature.level);
  const Vector2 place = places.on_level(feature.pixel);
  const auto u = static_cast<int>(std::lround(place.x())), v = static_cast<int>(std::lround(place.y()));
  const auto middle = static_cast<int>(std::lround(places.column(right_u)));
  const int reach = kSquareRadius_px + kShift_px + 1;
  if (u < reach || v < reach || u + reach >= left.width_px || v + reach >= left.height_px || middle < reach ||
      middle + reach >= right.width_px) {
    return {};
  }
  std::array<int, 2 * kShift_px + 1> sums{};
  int shifted = middle - kShift_px;
  for (int& sum : sums) sum = difference(left, right, u, v, shifted++);
  const auto best = std::min_element(sums.begin(), sums.end());
  if (best == sums.begin() || best == sums.end() - 1) return {};
  const double column = middle + static_cast<double>(best - sums.begin()) - kShift_px;
  const auto shift = square_shift(left, right, u, v, column);
  if (!shift) return {};
  // From the central pixel to the corner's sub-pixel position.
  const Vector2 off = place - Vector2(u, v), stretch((*shift)[2], (*shift)[3]);
  const double right_place = column + static_cast<double>((*shift)[1]) + off.x() + stretch.dot(off);
  return {places.image_column(right_place), -stretch, *best};
}

void drop_dissimilar(std::vector<Feature>& left, const std::vector<int>& differences, int& matched) {
  std::vector<int> sorted;
  for (const int d : differences) {
    if (d >= 0) sorted.push_back(d);
  }
  if (sorted.empty()) return;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double maximum = 1.5 * 1.4 * sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (differences[k] <= maximum) continue;
    left[k].right_u_px = left[k].depth_m = -1.0;
    left[k].disparity_slope.setZero();
    --matched;
  }
}

}  // namespace

StereoMatchStats match_stereo(std::vector<Feature>& left, const std::vector<Feature>& right,
                              const std::vector<PyramidLevel>& left_pyramid,
                              const std::vector<PyramidLevel>& right_pyramid, const StereoCamera& camera,
                              double min_depth_m, bool check_order) {
  const Rows rows(right, camera.height_px, 2.0), wide_rows(right, camera.height_px, check_order ? 12.0 : 0.0);
  const double max_disparity = camera.fx_px * camera.baseline_m / min_depth_m;
  StereoMatchStats stats;
  std::vector<int> differences(left.size(), -1);
  for (std::size_t k = 0; k < left.size(); ++k) {
    Feature& feature = left[k];
    const double u = feature.pixel.x(), v = feature.pixel.y();
    const BestMatch found = best_match(feature, right, rows.at(v), u - max_disparity, u);
    if (found.index < 0) {
      if (!check_order) continue;
      stats.swapped += best_match(feature, right, rows.at(v), u + 2.0, u + max_disparity).index >= 0 ? 1 : 0;
      stats.off_rows += best_match(feature, right, wide_rows.at(v), u - max_disparity, u).index >= 0 ? 1 : 0;
      continue;
    }
    const SubPixel place =
        refine(feature, right[static_cast<std::size_t>(found.index)].pixel.x(), left_pyramid, right_pyramid);
    const double disparity = u - place.right_u_px;
    if (place.right_u_px < 0.0 || disparity < kMinDisparity_px || disparity > max_disparity) continue;
    feature.right_u_px = place.right_u_px;
    feature.depth_m = camera.depth_m(disparity);
    feature.disparity_slope = place.slope;
    feature.off_row_px = right[static_cast<std::size_t>(found.index)].pixel.y() - v;
    differences[k] = place.difference;
    ++stats.matched;
  }
  drop_dissimilar(left, differences, stats.matched);
  return stats;
}

}  // namespace pharos::slam
