// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/stereo_match.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace pharos::slam {
namespace {

constexpr int kRadius_px = 5;  // of the pixels compared: 11x11
constexpr int kShift_px = 5;   // searched to each side of the right feature
constexpr int kLikest = (kSamePoint + kMaybeSamePoint) / 2;
constexpr double kLeastDisparity_px = 0.3;
constexpr float kLeastSlopes = 121.0F;  // squared grey values a pixel, over the square: less tells no place

// Right features by the rows that they may match.
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

struct Likest {
  int index = -1;
  int distance = kLikest;
};

Likest likest(const Feature& feature, const std::vector<Feature>& right, const std::vector<int>& candidates,
              double first_u, double last_u) {
  Likest best;
  for (const int k : candidates) {
    const Feature& other = right[static_cast<std::size_t>(k)];
    if (std::abs(other.level - feature.level) > 1 || other.pixel.x() < first_u || other.pixel.x() > last_u) continue;
    const int d = distance(feature.descriptor, other.descriptor);
    if (d < best.distance) best = {k, d};
  }
  return best;
}

// Sum of differences of two squares of pixels, each less its own middle: lamps differ from camera to camera.
int difference(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v, int right_u) {
  const int offset = left.at(u, v) - right.at(right_u, v);
  int sum = 0;
  for (int dv = -kRadius_px; dv <= kRadius_px; ++dv) {
    const std::uint8_t* a = left.row(v + dv) + u;
    const std::uint8_t* b = right.row(v + dv) + right_u;
    for (int du = -kRadius_px; du <= kRadius_px; ++du) sum += std::abs(a[du] - b[du] - offset);
  }
  return sum;
}

struct SubPixel {
  double right_u_px = -1.0;
  Vector2 slope = Vector2::Zero();  // of the disparity
  int difference = 0;
};

// The right square as the left one sees it: a difference of brightness, the shift, and how the shift changes along u
// and v, as it does on a surface that is seen aslant.
using Shift = Eigen::Vector4f;  // grey values, px, px per px along u, along v

// The left square, for Gauss and Newton on the sum of squared differences with its own slopes (Baker and Matthews
// 2004): they are gathered once.
class LeftSquare {
 public:
  LeftSquare(ImageView<const std::uint8_t> left, int u, int v) {
    Eigen::Matrix4f H = Eigen::Matrix4f::Zero();
    std::size_t k = 0;
    for (int dv = -kRadius_px; dv <= kRadius_px; ++dv) {
      const std::uint8_t* row = left.row(v + dv) + u;
      for (int du = -kRadius_px; du <= kRadius_px; ++du, ++k) {
        value_[k] = static_cast<float>(row[du]);
        slope_[k] = 0.5F * static_cast<float>(row[du + 1] - row[du - 1]);
        const auto x = static_cast<float>(du), y = static_cast<float>(dv);
        const Shift J(1.0F, slope_[k], slope_[k] * x, slope_[k] * y);
        H.noalias() += J * J.transpose();
      }
    }
    slopes_ = H(1, 1);
    solver_.compute(H);
  }
  bool told() const { return slopes_ > kLeastSlopes; }

  // What the shift lacks; empty where it leaves the image.
  std::optional<Shift> step(ImageView<const std::uint8_t> right, int v, double column, const Shift& shift) const {
    Shift g = Shift::Zero();
    std::size_t k = 0;
    const auto last = static_cast<float>(right.width_px - 2);
    for (int dv = -kRadius_px; dv <= kRadius_px; ++dv) {
      const std::uint8_t* row = right.row(v + dv);
      const auto y = static_cast<float>(dv);
      const float middle = static_cast<float>(column) + shift[1] + shift[3] * y, step = 1.0F + shift[2];
      if (!(middle - kRadius_px * step >= 0.0F && middle + kRadius_px * step < last)) return std::nullopt;
      float sum = 0.0F, sloped = 0.0F, sloped_x = 0.0F;
      for (int du = -kRadius_px; du <= kRadius_px; ++du, ++k) {
        const auto x = static_cast<float>(du);
        const float place = middle + step * x;
        const auto whole = static_cast<int>(place);
        const auto at = static_cast<float>(row[whole]), after = static_cast<float>(row[whole + 1]);
        const float off = value_[k] - (at + (place - static_cast<float>(whole)) * (after - at)) - shift[0];
        sum += off;
        sloped += slope_[k] * off;
        sloped_x += slope_[k] * x * off;
      }
      g += Shift(sum, sloped, sloped_x, y * sloped);
    }
    return solver_.solve(g);
  }

 private:
  static constexpr int kSide_px = 2 * kRadius_px + 1;
  std::array<float, static_cast<std::size_t>(kSide_px*kSide_px)> value_, slope_;
  float slopes_ = 0.0F;
  Eigen::LDLT<Eigen::Matrix4f> solver_;
};

// Where between pixels the right square equals the left one best, from `column` on. Empty where it runs away.
std::optional<Shift> align(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v,
                           double column) {
  constexpr int kSteps = 8;
  constexpr float kEnough_px = 0.005F, kMostShift_px = 1.0F, kMostStretch = 0.3F;
  const LeftSquare square(left, u, v);
  if (!square.told()) return std::nullopt;
  Shift shift = Shift::Zero();
  for (int k = 0; k < kSteps; ++k) {
    const auto move = square.step(right, v, column, shift);
    if (!move) return std::nullopt;
    shift += *move;
    if (!(std::abs(shift[1]) < kMostShift_px && shift.tail<2>().cwiseAbs().maxCoeff() < kMostStretch)) {
      return std::nullopt;
    }
    if (std::abs((*move)[1]) < kEnough_px) break;
  }
  return shift;
}

// The right column of a left feature, refined on the feature's level. Below 0 where no clear minimum is inside.
SubPixel refine(const Feature& feature, double right_u, const std::vector<PyramidLevel>& left_pyramid,
                const std::vector<PyramidLevel>& right_pyramid) {
  const auto level = static_cast<std::size_t>(feature.level);
  const ImageView<const std::uint8_t> left = left_pyramid[level].image, right = right_pyramid[level].image;
  const double scale = static_cast<double>(left_pyramid[0].image.width_px) / left.width_px;
  const double scale_v = static_cast<double>(left_pyramid[0].image.height_px) / left.height_px;
  const Vector2 place((feature.pixel.x() + 0.5) / scale - 0.5, (feature.pixel.y() + 0.5) / scale_v - 0.5);
  const auto u = static_cast<int>(std::lround(place.x())), v = static_cast<int>(std::lround(place.y()));
  const auto middle = static_cast<int>(std::lround((right_u + 0.5) / scale - 0.5));
  const int reach = kRadius_px + kShift_px + 1;
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
  const auto shift = align(left, right, u, v, column);
  if (!shift) return {};
  // From the middle pixel to the corner between pixels.
  const Vector2 off = place - Vector2(u, v), stretch((*shift)[2], (*shift)[3]);
  const double right_place = column + static_cast<double>((*shift)[1]) + off.x() + stretch.dot(off);
  return {(right_place + 0.5) * scale - 0.5, -stretch, *best};
}

void drop_unlike(std::vector<Feature>& left, const std::vector<int>& differences, int& matched) {
  std::vector<int> sorted;
  for (const int d : differences) {
    if (d >= 0) sorted.push_back(d);
  }
  if (sorted.empty()) return;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double most = 1.5 * 1.4 * sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (differences[k] <= most) continue;
    left[k].right_u_px = left[k].depth_m = -1.0;
    left[k].disparity_slope.setZero();
    --matched;
  }
}

}  // namespace

StereoMatchStats match_stereo(std::vector<Feature>& left, const std::vector<Feature>& right,
                              const std::vector<PyramidLevel>& left_pyramid,
                              const std::vector<PyramidLevel>& right_pyramid, const StereoCamera& camera,
                              double least_depth_m, bool check_order) {
  const Rows rows(right, camera.height_px, 2.0), wide_rows(right, camera.height_px, check_order ? 12.0 : 0.0);
  const double most_disparity = camera.fx_px * camera.baseline_m / least_depth_m;
  StereoMatchStats stats;
  std::vector<int> differences(left.size(), -1);
  for (std::size_t k = 0; k < left.size(); ++k) {
    Feature& feature = left[k];
    const double u = feature.pixel.x(), v = feature.pixel.y();
    const Likest found = likest(feature, right, rows.at(v), u - most_disparity, u);
    if (found.index < 0) {
      if (!check_order) continue;
      stats.swapped += likest(feature, right, rows.at(v), u + 2.0, u + most_disparity).index >= 0 ? 1 : 0;
      stats.off_rows += likest(feature, right, wide_rows.at(v), u - most_disparity, u).index >= 0 ? 1 : 0;
      continue;
    }
    const SubPixel place =
        refine(feature, right[static_cast<std::size_t>(found.index)].pixel.x(), left_pyramid, right_pyramid);
    const double disparity = u - place.right_u_px;
    if (place.right_u_px < 0.0 || disparity < kLeastDisparity_px || disparity > most_disparity) continue;
    feature.right_u_px = place.right_u_px;
    feature.depth_m = camera.depth_m(disparity);
    feature.disparity_slope = place.slope;
    feature.off_row_px = right[static_cast<std::size_t>(found.index)].pixel.y() - v;
    differences[k] = place.difference;
    ++stats.matched;
  }
  drop_unlike(left, differences, stats.matched);
  return stats;
}

}  // namespace pharos::slam
