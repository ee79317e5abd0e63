// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pharos::sim {
namespace {

// Beyond so many sigmas a Gaussian holds 6e-5 of its weight.
constexpr double kReachSigmas = 4.0;

template <typename Weight>
Kernel kernel_of(double sigma_px, const Weight& weight) {
  if (sigma_px <= 0.0) return {1.0F};
  const int reach = std::max(1, static_cast<int>(std::ceil(kReachSigmas * sigma_px)));
  Kernel weights;
  for (int i = 0; i <= reach; ++i) weights.push_back(static_cast<float>(weight(i)));
  float total = weights[0];
  for (std::size_t i = 1; i < weights.size(); ++i) total += 2.0F * weights[i];
  for (float& one : weights) one /= total;
  return weights;
}

// out[i] = sum over k of kernel[|k|] of the pixel k beyond i; `pixel(k)` begins a line that is moved by k pixels.
template <typename Line>
void convolve_line(const Line& line, const Kernel& kernel, float* out, std::size_t count) {
  const float* middle = line(0);
  for (std::size_t i = 0; i < count; ++i) out[i] = kernel[0] * middle[i];
  for (std::size_t k = 1; k < kernel.size(); ++k) {
    const float weight = kernel[k];
    const float* before = line(-static_cast<int>(k));
    const float* after = line(static_cast<int>(k));
    for (std::size_t i = 0; i < count; ++i) out[i] += weight * (after[i] + before[i]);
  }
}

}  // namespace

Kernel gaussian_over_pixels(double sigma_px) {
  const auto below = [sigma_px](double x) { return 0.5 * std::erf(x / (sigma_px * std::sqrt(2.0))); };
  return kernel_of(sigma_px, [&](int i) { return below(i + 0.5) - below(i - 0.5); });
}

Kernel gaussian_at_pixels(double sigma_px) {
  return kernel_of(sigma_px, [&](int i) { return std::exp(-0.5 * i * i / (sigma_px * sigma_px)); });
}

double variance_ratio(const Kernel& kernel) {
  double squares = 0.0;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    squares += (i == 0 ? 1.0 : 2.0) * static_cast<double>(kernel[i]) * static_cast<double>(kernel[i]);
  }
  return squares * squares;
}

void convolve(std::vector<float>& pixels, int width_px, int height_px, const Kernel& kernel) {
  if (kernel.size() < 2 || pixels.empty()) return;
  const auto reach = static_cast<std::ptrdiff_t>(kernel.size()) - 1;
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<float> line(width + 2 * kernel.size());
  for (int v = 0; v < height_px; ++v) {
    float* row = pixels.data() + static_cast<std::size_t>(v) * width;
    std::fill_n(line.begin(), reach, row[0]);
    std::copy_n(row, width, line.begin() + reach);
    std::fill_n(line.begin() + reach + width_px, reach, row[width - 1]);
    convolve_line([&](int k) { return line.data() + reach + k; }, kernel, row, width);
  }
  const std::vector<float> across = pixels;
  for (int v = 0; v < height_px; ++v) {
    const auto row_of = [&](int k) {
      return across.data() + static_cast<std::size_t>(std::clamp(v + k, 0, height_px - 1)) * width;
    };
    convolve_line(row_of, kernel, pixels.data() + static_cast<std::size_t>(v) * width, width);
  }
}

LinearImage blurred(const LinearImage& image, double sigma_px) {
  LinearImage out = image;
  convolve(out.light, out.width_px, out.height_px, gaussian_over_pixels(sigma_px));
  return out;
}

}  // namespace pharos::sim
