// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/blobs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace pharos::calibrate {
namespace {

// Between the level of a board's sheet and its dots, whether they take a twentieth or a half of it.
constexpr double kThresholdDeviations = 0.75;
// A window that holds part of a board deviates by far more than noise.
constexpr double kMinContrast = 4.0;
constexpr double kMinArea_px = 6.0;
constexpr double kLargestFraction = 0.02;  // of the image
// Area over that of the ellipse with the same moments; 1 for an ellipse, a square has 0.95, a cross of dots 0.6.
constexpr double kMinFill = 0.85;
constexpr double kMaxElongated = 5.0;

// Sums over any rectangle from four reads.
class RunningSums {
 public:
  explicit RunningSums(GreyView image) : width_(image.width_px), height_(image.height_px) {
    const auto across = static_cast<std::size_t>(width_) + 1;
    sums_.resize(across * (static_cast<std::size_t>(height_) + 1));
    for (std::int32_t v = 0; v < height_; ++v) {
      std::array<double, 2> row{};
      for (std::int32_t u = 0; u < width_; ++u) {
        const double grey = image.at(u, v);
        row[0] += grey;
        row[1] += grey * grey;
        const std::array<double, 2>& above = at(u + 1, v);
        at(u + 1, v + 1) = {above[0] + row[0], above[1] + row[1]};
      }
    }
  }

  struct Level {
    double mean = 0.0;
    double deviation = 0.0;
  };
  Level around(std::int32_t u, std::int32_t v, std::int32_t reach) {
    const std::int32_t left = std::max(u - reach, 0), right = std::min(u + reach + 1, width_);
    const std::int32_t top = std::max(v - reach, 0), bottom = std::min(v + reach + 1, height_);
    const double count = static_cast<double>(right - left) * (bottom - top);
    const auto sum = [&](std::size_t k) {
      return at(right, bottom)[k] - at(left, bottom)[k] - at(right, top)[k] + at(left, top)[k];
    };
    const double mean = sum(0) / count;
    return {mean, std::sqrt(std::max(sum(1) / count - mean * mean, 0.0))};
  }

 private:
  std::array<double, 2>& at(std::int32_t u, std::int32_t v) {
    return sums_[static_cast<std::size_t>(v) * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(u)];
  }

  std::int32_t width_;
  std::int32_t height_;
  std::vector<std::array<double, 2>> sums_;
};

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
  return std::max(*middle / (0.6745 * std::sqrt(6.0)), 0.5);  // a count is never known better than by half
}

std::vector<std::uint8_t> mask_of(GreyView image, int window_px, bool bright) {
  RunningSums sums(image);
  const double min_deviation = kMinContrast * noise_of(image);
  std::vector<std::uint8_t> mask(image.pixels());
  std::size_t at = 0;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u, ++at) {
      const RunningSums::Level level = sums.around(u, v, window_px / 2);
      const double above = bright ? image.at(u, v) - level.mean : level.mean - image.at(u, v);
      mask[at] = level.deviation > min_deviation && above > kThresholdDeviations * level.deviation ? 1 : 0;
    }
  }
  return mask;
}

struct Moments {
  double area = 0.0;
  Vector2 sum = Vector2::Zero();
  Matrix2 squares = Matrix2::Zero();
  bool cut = false;
};

// Takes the connected pixels (four neighbours) out of the mask.
Moments take_region(std::vector<std::uint8_t>& mask, std::int32_t width, std::int32_t height, std::size_t seed,
                    std::vector<std::size_t>& queue) {
  Moments moments;
  queue.assign(1, seed);
  mask[seed] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const auto u = static_cast<std::int32_t>(queue[next] % static_cast<std::size_t>(width));
    const auto v = static_cast<std::int32_t>(queue[next] / static_cast<std::size_t>(width));
    const Vector2 pixel(u, v);
    moments.area += 1.0;
    moments.sum += pixel;
    moments.squares += pixel * pixel.transpose();
    constexpr std::array<std::pair<int, int>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [du, dv] : kNeighbours) {
      const std::int32_t nu = u + du, nv = v + dv;
      if (nu < 0 || nv < 0 || nu >= width || nv >= height) {
        moments.cut = true;
        continue;
      }
      const std::size_t index =
          static_cast<std::size_t>(nv) * static_cast<std::size_t>(width) + static_cast<std::size_t>(nu);
      if (mask[index] == 0) continue;
      mask[index] = 0;
      queue.push_back(index);
    }
  }
  return moments;
}

bool is_elliptic(const Blob& blob, double area) {
  const double trace = blob.covariance_px2.trace(), determinant = blob.covariance_px2.determinant();
  if (determinant <= 0.0) return false;
  const double ellipse = 4.0 * std::numbers::pi * std::sqrt(determinant);
  const double spread = std::sqrt(std::max(0.25 * trace * trace - determinant, 0.0));
  const double axes = std::sqrt((0.5 * trace + spread) / std::max(0.5 * trace - spread, 1e-9));
  return area > kMinFill * ellipse && axes < kMaxElongated;
}

}  // namespace

double Blob::area_px() const { return 4.0 * std::numbers::pi * std::sqrt(covariance_px2.determinant()); }

std::vector<Blob> find_blobs(GreyView image, int window_px, bool bright) {
  std::vector<std::uint8_t> mask = mask_of(image, window_px, bright);
  const double largest = kLargestFraction * static_cast<double>(image.pixels());
  std::vector<Blob> blobs;
  std::vector<std::size_t> queue;
  for (std::size_t seed = 0; seed < mask.size(); ++seed) {
    if (mask[seed] == 0) continue;
    const Moments moments = take_region(mask, image.width_px, image.height_px, seed, queue);
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

}  // namespace pharos::calibrate
