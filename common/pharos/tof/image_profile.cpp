// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/image_profile.hpp"

#include <algorithm>

namespace pharos::tof {
namespace {

// Derivative of a Gaussian of 1 px at -3 .. 3 px.
constexpr int kReach = 3;
constexpr std::array<double, 7> kSlope = {-0.0133, -0.108, -0.242, 0.0, 0.242, 0.108, 0.0133};

double bilinear(const ImageView<const std::uint16_t>& image, const Vector2& pixel) {
  const int u = static_cast<int>(pixel.x());
  const int v = static_cast<int>(pixel.y());
  const double s = pixel.x() - u;
  const double t = pixel.y() - v;
  const std::uint16_t* upper = image.row(v) + u;
  const std::uint16_t* lower = upper + image.stride_px;
  return (1.0 - t) * ((1.0 - s) * upper[0] + s * upper[1]) + t * ((1.0 - s) * lower[0] + s * lower[1]);
}

bool inside(const ImageView<const std::uint16_t>& image, const Vector2& pixel) {
  return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < image.width_px - 1.0 && pixel.y() < image.height_px - 1.0;
}

}  // namespace

ProfileEdge steepest_on_profile(const ImageView<const std::uint16_t>& image, const Vector2& middle,
                                const Vector2& direction, int search_px, double sign) {
  const int search = std::clamp(search_px, 1, kMostSearch_px);
  const double reach = search + kReach;
  if (!inside(image, middle - reach * direction) || !inside(image, middle + reach * direction)) return {};
  std::array<double, 2 * (kMostSearch_px + kReach) + 1> profile{};
  for (int i = 0; i <= 2 * (search + kReach); ++i) {
    profile[static_cast<std::size_t>(i)] = bilinear(image, middle + (i - reach) * direction);
  }
  std::array<double, 2 * kMostSearch_px + 1> slope{};
  int best = 0;
  for (int k = 0; k <= 2 * search; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kSlope.size(); ++i) sum += kSlope[i] * profile[static_cast<std::size_t>(k) + i];
    slope[static_cast<std::size_t>(k)] = sign * sum;
    if (slope[static_cast<std::size_t>(k)] > slope[static_cast<std::size_t>(best)]) best = k;
  }
  if (best == 0 || best == 2 * search) return {};
  const double left = slope[static_cast<std::size_t>(best - 1)];
  const double top = slope[static_cast<std::size_t>(best)];
  const double right = slope[static_cast<std::size_t>(best + 1)];
  const double bend = left - 2.0 * top + right;
  if (!(bend < 0.0) || !(top > 0.0)) return {};
  const auto middle_index = static_cast<std::size_t>(best + kReach);
  return {best - search + 0.5 * (left - right) / bend, top,
          0.5 * (profile[middle_index - 2] + profile[middle_index - 3]),
          0.5 * (profile[middle_index + 2] + profile[middle_index + 3])};
}

}  // namespace pharos::tof
