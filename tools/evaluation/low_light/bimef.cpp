// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/evaluation/low_light/plane.hpp"
#include "tools/evaluation/low_light/published_methods.hpp"

namespace pharos::tools {
namespace {

// Of the camera's response g(P, k) = exp(b (1 - k^a)) P^(k^a).
constexpr double kA = -0.3293, kB = 1.1258;
constexpr double kMu = 0.5;      // weight W = T^mu
constexpr double kLambda = 1.0;  // of smoothness
constexpr double kEpsilon = 0.001;
constexpr int kReach_px = 2;       // window of 5 pixels
constexpr double kDark = 0.5;      // below, a pixel is under-exposed
constexpr double kMaxRatio = 7.0;  // of exposures

double response(double value, double ratio) {
  const double power = std::pow(ratio, kA);
  return std::min(1.0, std::exp(kB * (1.0 - power)) * std::pow(value, power));
}

// lambda / ((|sum of gradients in a window| + eps) (|gradient| + eps)), windows along the gradient's direction.
Plane weights_of(const Plane& gradient, bool along_rows) {
  Plane weights = gradient;
  for (int v = 0; v < gradient.height_px; ++v) {
    for (int u = 0; u < gradient.width_px; ++u) {
      double sum = 0.0;
      for (int k = -kReach_px; k <= kReach_px; ++k) {
        const int x = std::clamp(along_rows ? u + k : u, 0, gradient.width_px - 1);
        const int y = std::clamp(along_rows ? v : v + k, 0, gradient.height_px - 1);
        sum += gradient.at(x, y);
      }
      weights.at(u, v) = kLambda / ((std::abs(sum) + kEpsilon) * (std::abs(gradient.at(u, v)) + kEpsilon));
    }
  }
  return weights;
}

// Of the grey values of 8 bits.
double entropy_of(const std::vector<double>& values, double ratio) {
  std::array<double, 256> counts{};
  for (const double value : values) counts[static_cast<std::size_t>(255.0 * response(value, ratio))] += 1.0;
  double entropy = 0.0;
  for (const double count : counts) {
    if (count <= 0.0) continue;
    const double fraction = count / static_cast<double>(values.size());
    entropy -= fraction * std::log2(fraction);
  }
  return entropy;
}

// Means of 50 x 50 parts, on which the publication looks for k.
Plane small_of(const Plane& plane) {
  constexpr int kSide = 50;
  Plane sums(kSide, kSide), counts(kSide, kSide);
  for (int v = 0; v < plane.height_px; ++v) {
    for (int u = 0; u < plane.width_px; ++u) {
      const int x = u * kSide / plane.width_px, y = v * kSide / plane.height_px;
      sums.at(x, y) += plane.at(u, v);
      counts.at(x, y) += 1.0;
    }
  }
  for (std::size_t i = 0; i < sums.values.size(); ++i) sums.values[i] /= std::max(1.0, counts.values[i]);
  return sums;
}

// The ratio at which the under-exposed pixels have most entropy.
double best_ratio(const Plane& image, const Plane& light) {
  constexpr double kStep = 0.1;
  std::vector<double> dark;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (light.values[i] < kDark) dark.push_back(image.values[i]);
  }
  double best = 1.0, most = -1.0;
  if (dark.empty()) return best;
  for (int step = 0; 1.0 + kStep * step <= kMaxRatio; ++step) {
    const double ratio = 1.0 + kStep * step;
    const double entropy = entropy_of(dark, ratio);
    if (entropy <= most) continue;
    most = entropy;
    best = ratio;
  }
  return best;
}

}  // namespace

// Two exposures, the image and one that the camera's response makes of it, fused by the light T of the scene.
GreyBytes bimef(const GreyBytes& image, int width_px, int height_px) {
  const Plane first = plane_of(image, width_px, height_px);
  const Gradient gradient = gradient_of(first);
  const Plane light =
      smoothest(first, {weights_of(gradient.right, true), weights_of(gradient.down, false)}, first, {0.01, 500});
  const double ratio = best_ratio(small_of(first), small_of(light));
  Plane fused = first;
  for (std::size_t i = 0; i < fused.values.size(); ++i) {
    const double weight = std::pow(std::clamp(light.values[i], 0.0, 1.0), kMu);
    fused.values[i] = weight * first.values[i] + (1.0 - weight) * response(first.values[i], ratio);
  }
  return bytes_of(fused);
}

}  // namespace pharos::tools
