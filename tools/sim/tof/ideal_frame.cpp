// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/ideal_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pharos::sim {
namespace {

constexpr int kTile_px = 16;  // rays of a tile share the list of parts that they may meet
// Steps of depth between neighbours that are an edge and no slope, over the distance.
constexpr float kDepthStep = 0.006F;
constexpr int kSubpixels = 16;

// Hammersley's points: every row and column of a 16 x 16 grid once, so that straight edges are covered evenly.
constexpr std::array<std::array<double, 2>, kSubpixels> make_subpixels() {
  std::array<std::array<double, 2>, kSubpixels> points{};
  for (int i = 0; i < kSubpixels; ++i) {
    const int reversed = (i & 1) << 3 | (i & 2) << 1 | (i & 4) >> 1 | (i & 8) >> 3;
    points[static_cast<std::size_t>(i)] = {(i + 0.5) / kSubpixels - 0.5, (reversed + 0.5) / kSubpixels - 0.5};
  }
  return points;
}
constexpr auto kSubpixel = make_subpixels();

struct Light {
  double amplitude = 0.0;
  double amplitude_range = 0.0;
};

class Picture {
 public:
  Picture(const Scene& scene, const Lens& lens, const ImagingModel& imaging)
      : scene_(scene),
        lens_(lens),
        imaging_(imaging),
        width_(lens.model().width_px),
        height_(lens.model().height_px),
        tiles_across_((width_ + kTile_px - 1) / kTile_px) {
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    amplitude_.resize(count);
    moment_.resize(count);
    depth_.resize(count);
    surface_.resize(count);
  }

  IdealFrame render() {
    find_parts();
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) cast_centre(u, v);
    }
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        if (on_edge(u, v)) cast_area(u, v);
      }
    }
    blur(amplitude_, width_, height_, imaging_.blur_px);
    blur(moment_, width_, height_, imaging_.blur_px);
    for (std::size_t i = 0; i < moment_.size(); ++i) {
      moment_[i] = amplitude_[i] > 0.0F ? moment_[i] / amplitude_[i] : 0.0F;
    }
    return {std::move(amplitude_), std::move(moment_)};
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  void find_parts() {
    for (int v = 0; v < height_; v += kTile_px) {
      for (int u = 0; u < width_; u += kTile_px) {
        const auto direction = [&](int across, int down) {
          const Vector2& ray = lens_.ray(std::min(u + across, width_), std::min(v + down, height_));
          return Vector3(ray.x(), ray.y(), 1.0).normalized();
        };
        const Vector3 middle = direction(kTile_px / 2, kTile_px / 2);
        double half_angle = 0.0;
        for (const int across : {-1, kTile_px}) {
          for (const int down : {-1, kTile_px}) {
            half_angle = std::max(half_angle, (direction(across, down) - middle).norm());
          }
        }
        parts_.push_back(scene_.parts_near(middle, 1.1 * half_angle));
      }
    }
  }
  Scene::Parts parts(int u, int v) const {
    return parts_[static_cast<std::size_t>(v / kTile_px) * static_cast<std::size_t>(tiles_across_) +
                  static_cast<std::size_t>(u / kTile_px)];
  }

  Light light_of(const Hit& hit, double range_per_depth) const {
    if (hit.surface == static_cast<int>(SurfaceKind::kSpace)) return {};
    const double range = hit.depth_m * range_per_depth;
    const double near = kNominalRange_m / range;
    const double amplitude = imaging_.nominal_counts * near * near * hit.reflectance / kNominalReflectance;
    return {amplitude, amplitude * (range + imaging_.multipath * hit.multipath_m)};
  }

  void cast_centre(int u, int v) {
    const Vector2& ray = lens_.ray(u, v);
    const Hit hit = scene_.trace(ray, parts(u, v));
    const Light light = light_of(hit, lens_.range_per_depth(u, v));
    const std::size_t i = index(u, v);
    amplitude_[i] = static_cast<float>(light.amplitude);
    moment_[i] = static_cast<float>(light.amplitude_range);
    depth_[i] = static_cast<float>(hit.depth_m);
    surface_[i] = static_cast<std::uint8_t>(hit.surface);
  }

  void cast_area(int u, int v) {
    const Vector2& middle = lens_.ray(u, v);
    const Eigen::Matrix2d slope = lens_.slope(u, v);
    Light sum;
    for (const auto& [across, down] : kSubpixel) {
      const Vector2 ray = middle + slope * Vector2(across, down);
      const Light light = light_of(scene_.trace(ray, parts(u, v)), std::sqrt(1.0 + ray.squaredNorm()));
      sum.amplitude += light.amplitude;
      sum.amplitude_range += light.amplitude_range;
    }
    const std::size_t i = index(u, v);
    amplitude_[i] = static_cast<float>(sum.amplitude / kSubpixels);
    moment_[i] = static_cast<float>(sum.amplitude_range / kSubpixels);
  }

  bool on_edge(int u, int v) const {
    const std::size_t i = index(u, v);
    const auto differs = [&](std::size_t j) {
      return surface_[i] != surface_[j] || std::abs(depth_[i] - depth_[j]) > kDepthStep * depth_[i];
    };
    const auto width = static_cast<std::size_t>(width_);
    return (u > 0 && differs(i - 1)) || (u + 1 < width_ && differs(i + 1)) || (v > 0 && differs(i - width)) ||
           (v + 1 < height_ && differs(i + width));
  }

  const Scene& scene_;
  const Lens& lens_;
  const ImagingModel& imaging_;
  int width_;
  int height_;
  int tiles_across_;
  std::vector<Scene::Parts> parts_;
  std::vector<float> amplitude_;
  std::vector<float> moment_;  // amplitude times range
  std::vector<float> depth_;
  std::vector<std::uint8_t> surface_;
};

std::vector<float> gaussian(double sigma_px) {
  const int half = std::max(1, static_cast<int>(std::ceil(3.0 * sigma_px)));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double value = std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    kernel.push_back(static_cast<float>(value));
    sum += value;
  }
  for (float& value : kernel) value /= static_cast<float>(sum);
  return kernel;
}

// out[i] = sum over k of kernel[k] line[i + k].
void convolve(const float* line, const std::vector<float>& kernel, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = kernel[0] * line[i];
  for (std::size_t k = 1; k < kernel.size(); ++k) {
    const float weight = kernel[k];
    for (std::size_t i = 0; i < count; ++i) out[i] += weight * line[i + k];
  }
}

}  // namespace

void blur(std::vector<float>& image, int width_px, int height_px, double sigma_px) {
  if (sigma_px <= 0.0) return;
  const std::vector<float> kernel = gaussian(sigma_px);
  const auto half = static_cast<int>(kernel.size() / 2);
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<float> line(width + kernel.size());
  for (int v = 0; v < height_px; ++v) {
    float* row = image.data() + static_cast<std::size_t>(v) * width;
    for (int u = -half; u < width_px + half; ++u) {
      const int mirrored = u < 0 ? -u - 1 : u >= width_px ? 2 * width_px - 1 - u : u;
      line[static_cast<std::size_t>(u + half)] = row[mirrored];
    }
    convolve(line.data(), kernel, row, width);
  }
  // Down the columns: whole rows are added, from copies of the rows that are overwritten on the way.
  const std::vector<float> across = image;
  const auto row_of = [&](int v) {
    const int mirrored = v < 0 ? -v - 1 : v >= height_px ? 2 * height_px - 1 - v : v;
    return across.data() + static_cast<std::size_t>(mirrored) * width;
  };
  for (int v = 0; v < height_px; ++v) {
    float* out = image.data() + static_cast<std::size_t>(v) * width;
    for (int k = -half; k <= half; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k + half)];
      const float* in = row_of(v + k);
      for (std::size_t u = 0; u < width; ++u) out[u] = (k == -half ? 0.0F : out[u]) + weight * in[u];
    }
  }
}

IdealFrame render_ideal(const Scene& scene, const Lens& lens, const ImagingModel& imaging) {
  return Picture(scene, lens, imaging).render();
}

}  // namespace pharos::sim
