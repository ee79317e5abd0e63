// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/smoothness.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/enhance/wide_vectors.hpp"

namespace pharos::enhance {
namespace {

using Index = std::ptrdiff_t;

// Taps of half a Gaussian, the whole of which sums to one.
std::vector<float> half_gaussian(double sigma_px) {
  const auto radius = static_cast<std::size_t>(std::ceil(3.0 * sigma_px));
  std::vector<float> taps(radius + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k <= radius; ++k) {
    const double x = static_cast<double>(k) / sigma_px;
    const double tap = std::exp(-0.5 * x * x);
    taps[k] = static_cast<float>(tap);
    sum += k == 0 ? tap : 2.0 * tap;
  }
  for (float& tap : taps) tap = static_cast<float>(static_cast<double>(tap) / sum);
  return taps;
}

// Sum of the taps within 0 ... size-1, for each position.
std::vector<float> fractions(const std::vector<float>& taps, Index size) {
  std::vector<float> found(static_cast<std::size_t>(size));
  const auto radius = static_cast<Index>(taps.size()) - 1;
  for (Index at = 0; at < size; ++at) {
    for (Index k = -radius; k <= radius; ++k) {
      if (at + k >= 0 && at + k < size) {
        found[static_cast<std::size_t>(at)] += taps[static_cast<std::size_t>(std::abs(k))];
      }
    }
  }
  return found;
}

PHAROS_WIDE_VECTORS void gather_rows(const float* in, float* out, const std::vector<float>& taps, Index width,
                                     Index height) {
  const auto radius = static_cast<Index>(taps.size()) - 1;
  for (Index v = 0; v < height; ++v) {
    float* to = out + v * width;
    const float* from = in + v * width;
    for (Index u = 0; u < width; ++u) to[u] = taps[0] * from[u];
    for (Index k = 1; k <= std::min(radius, width - 1); ++k) {
      const float tap = taps[static_cast<std::size_t>(k)];
      for (Index u = k; u < width; ++u) to[u] += tap * from[u - k];
      for (Index u = 0; u < width - k; ++u) to[u] += tap * from[u + k];
    }
  }
}

PHAROS_WIDE_VECTORS void gather_columns(const float* in, float* out, const std::vector<float>& taps, Index width,
                                        Index height) {
  const auto radius = static_cast<Index>(taps.size()) - 1;
  for (Index v = 0; v < height; ++v) {
    float* to = out + v * width;
    for (Index u = 0; u < width; ++u) to[u] = taps[0] * in[v * width + u];
    for (Index k = 1; k <= radius; ++k) {
      const float tap = taps[static_cast<std::size_t>(k)];
      const float* above = v - k >= 0 ? in + (v - k) * width : nullptr;
      const float* below = v + k < height ? in + (v + k) * width : nullptr;
      if (above != nullptr && below != nullptr) {
        for (Index u = 0; u < width; ++u) to[u] += tap * (above[u] + below[u]);
      } else if (above != nullptr || below != nullptr) {
        const float* one = above != nullptr ? above : below;
        for (Index u = 0; u < width; ++u) to[u] += tap * one[u];
      }
    }
  }
}

}  // namespace

void max_of_channels(const FloatImage& frame, FloatImage& start) {
  start.shape(frame.width_px, frame.height_px, 1);
  std::copy_n(frame.plane(0), frame.pixels(), start.plane(0));
  for (int c = 1; c < frame.channels; ++c) {
    const float* more = frame.plane(c);
    for (std::size_t k = 0; k < frame.pixels(); ++k) start.values[k] = std::max(start.values[k], more[k]);
  }
}

PHAROS_WIDE_VECTORS void SmoothnessWeights::weigh(const FloatImage& start, WeightStrategy strategy, double alpha,
                                                  double sigma_px, SmoothnessSystem& system) {
  const Index width = start.width_px, height = start.height_px;
  const float weight = static_cast<float>(alpha);
  system.width_px = start.width_px;
  system.height_px = start.height_px;
  for (std::vector<float>* links : {&system.right, &system.down}) links->assign(start.pixels(), 0.0F);
  const std::vector<float> taps = half_gaussian(sigma_px);
  const std::vector<float> fraction_u = fractions(taps, width), fraction_v = fractions(taps, height);
  across_.resize(start.pixels());
  gathered_.resize(start.pixels());

  const auto fill = [&](Index step, Index columns, Index rows, std::vector<float>& links) {
    std::fill(across_.begin(), across_.end(), 0.0F);
    for (Index v = 0; v < rows; ++v) {
      const float* from = start.plane(0) + v * width;
      float* to = across_.data() + v * width;
      for (Index u = 0; u < columns; ++u) to[u] = from[u + step] - from[u];
    }
    if (strategy == WeightStrategy::kWindow) {
      gather_rows(across_.data(), links.data(), taps, width, height);
      gather_columns(links.data(), gathered_.data(), taps, width, height);
      std::fill(links.begin(), links.end(), 0.0F);
    }
    for (Index v = 0; v < rows; ++v) {
      const float* difference = across_.data() + v * width;
      const float* window = gathered_.data() + v * width;
      float* to = links.data() + v * width;
      const float fraction = fraction_v[static_cast<std::size_t>(v)];
      switch (strategy) {
        case WeightStrategy::kUniform:
          for (Index u = 0; u < columns; ++u) to[u] = weight / (std::abs(difference[u]) + kFlat);
          break;
        case WeightStrategy::kGradient:
          for (Index u = 0; u < columns; ++u) {
            const float d = std::abs(difference[u]) + kFlat;
            to[u] = weight / (d * d);
          }
          break;
        case WeightStrategy::kWindow:
          for (Index u = 0; u < columns; ++u) {
            to[u] = weight * fraction * fraction_u[static_cast<std::size_t>(u)] /
                    ((std::abs(window[u]) + kFlat) * (std::abs(difference[u]) + kFlat));
          }
          break;
      }
    }
  };
  fill(1, width - 1, height, system.right);
  fill(width, width, height - 1, system.down);
}

}  // namespace pharos::enhance
