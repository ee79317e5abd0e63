// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/ideal_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tools/sim/optics/blur.hpp"
#include "tools/sim/render/subpixels.hpp"

namespace pharos::sim {
namespace {

constexpr int kTile_px = 16;  // rays of a tile share the list of parts that they may meet
// Steps of depth between neighbours that are an edge and no slope, over the distance.
constexpr float kDepthStep = 0.006F;

struct Light {
  double amplitude = 0.0;
  double amplitude_range = 0.0;
  double amplitude_range2 = 0.0;
};

class Picture {
 public:
  Picture(const Scene& scene, const PixelRays& rays, const ImagingModel& imaging)
      : scene_(scene),
        rays_(rays),
        imaging_(imaging),
        width_(rays.lens().width_px),
        height_(rays.lens().height_px),
        tiles_across_((width_ + kTile_px - 1) / kTile_px) {
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    amplitude_.resize(count);
    moment_.resize(count);
    second_.resize(count);
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
    // Pixels are averages over their area already.
    const Kernel kernel = gaussian_at_pixels(imaging_.blur_px);
    convolve(amplitude_, width_, height_, kernel);
    convolve(moment_, width_, height_, kernel);
    convolve(second_, width_, height_, kernel);
    for (std::size_t i = 0; i < moment_.size(); ++i) {
      moment_[i] = amplitude_[i] > 0.0F ? moment_[i] / amplitude_[i] : 0.0F;
      const float variance = amplitude_[i] > 0.0F ? second_[i] / amplitude_[i] - moment_[i] * moment_[i] : 0.0F;
      second_[i] = std::sqrt(std::max(0.0F, variance));
    }
    return {std::move(amplitude_), std::move(moment_), std::move(second_)};
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  void find_parts() {
    for (int v = 0; v < height_; v += kTile_px) {
      for (int u = 0; u < width_; u += kTile_px) {
        const auto direction = [&](int across, int down) {
          const Vector2& ray = rays_.ray(std::min(u + across, width_), std::min(v + down, height_));
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
    const double seen = range + imaging_.multipath * hit.multipath_m;
    return {amplitude, amplitude * seen, amplitude * seen * seen};
  }

  void cast_centre(int u, int v) {
    const Vector2& ray = rays_.ray(u, v);
    const Hit hit = scene_.trace(ray, parts(u, v));
    const Light light = light_of(hit, rays_.range_per_depth(u, v));
    const std::size_t i = index(u, v);
    amplitude_[i] = static_cast<float>(light.amplitude);
    moment_[i] = static_cast<float>(light.amplitude_range);
    second_[i] = static_cast<float>(light.amplitude_range2);
    depth_[i] = static_cast<float>(hit.depth_m);
    surface_[i] = static_cast<std::uint8_t>(hit.surface);
  }

  void cast_area(int u, int v) {
    const Vector2& middle = rays_.ray(u, v);
    const Eigen::Matrix2d slope = rays_.slope(u, v);
    Light sum;
    for (const auto& [across, down] : kHammersleySubpixels) {
      const Vector2 ray = middle + slope * Vector2(across, down);
      const Light light = light_of(scene_.trace(ray, parts(u, v)), std::sqrt(1.0 + ray.squaredNorm()));
      sum.amplitude += light.amplitude;
      sum.amplitude_range += light.amplitude_range;
      sum.amplitude_range2 += light.amplitude_range2;
    }
    const std::size_t i = index(u, v);
    constexpr auto kCount = static_cast<double>(kHammersleySubpixels.size());
    amplitude_[i] = static_cast<float>(sum.amplitude / kCount);
    moment_[i] = static_cast<float>(sum.amplitude_range / kCount);
    second_[i] = static_cast<float>(sum.amplitude_range2 / kCount);
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
  const PixelRays& rays_;
  const ImagingModel& imaging_;
  int width_;
  int height_;
  int tiles_across_;
  std::vector<Scene::Parts> parts_;
  std::vector<float> amplitude_;
  std::vector<float> moment_;  // amplitude times range
  std::vector<float> second_;  // amplitude times range squared
  std::vector<float> depth_;
  std::vector<std::uint8_t> surface_;
};

}  // namespace

IdealFrame render_ideal(const Scene& scene, const PixelRays& rays, const ImagingModel& imaging) {
  return Picture(scene, rays, imaging).render();
}

}  // namespace pharos::sim
