// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/top_height.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pharos/tof/constants.hpp"
#include "pharos/tof/median.hpp"

namespace pharos::tof {
namespace {

class TopMeasurer {
 public:
  TopMeasurer(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& ring,
              const RaisedBox& box)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        ring_(ring),
        axes_(axes_of(ring.normal)),
        plane_(ring.plane()),
        box_(box) {}

  TopHeight measure() const {
    TopHeight top{box_.height_m, 0.25 * box_.step_m(), base(), 0.0};
    measure_top(top);
    return top;
  }

 private:
  struct Sample {
    double height_m = 0.0;
    double light = 0.0;
  };

  void measure_top(TopHeight& top) const {
    constexpr int kGrid = 9;
    std::array<double, kGrid * kGrid> heights{}, lights{};
    std::size_t count = 0;
    const PlanarRectangle& r = box_.rectangle;
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double s = 0.7 * (2.0 * i / (kGrid - 1) - 1.0) * r.half_sides_m.x();
        const double t = 0.7 * (2.0 * j / (kGrid - 1) - 1.0) * r.half_sides_m.y();
        const auto sample = sample_at(r.centre_m + s * r.outward(0) + t * r.outward(1), box_.height_m);
        if (!sample) continue;
        lights[count] = sample->light;
        heights[count++] = sample->height_m;
      }
    }
    if (count <= 8) return;
    top.light = median(lights.data(), count);
    top.height_m = median(heights.data(), count);
    for (std::size_t i = 0; i < count; ++i) heights[i] = std::fabs(heights[i] - top.height_m);
    const double spread = kMedianToSigma * median(heights.data(), count);
    // Noise is correlated between samples: a seventh of them count. A median is noisier than a mean by 1.25.
    top.sigma_height_m = 1.25 * spread / std::sqrt(std::max(1.0, static_cast<double>(count) / 7.0));
  }

  double base() const {
    constexpr int kAround = 64;
    std::array<double, kAround> feet{};
    std::size_t found = 0;
    const PlanarRectangle& r = box_.rectangle;
    const double halfway = 0.5 * (box_.height_m + box_.base_m);
    for (int k = 0; k < kAround; ++k) {
      const double angle = kTwoPi * k / kAround;
      const Vector2 place = r.centre_m + 1.9 * r.half_sides_m.maxCoeff() * Vector2(std::cos(angle), std::sin(angle));
      const auto sample = sample_at(place, box_.base_m);
      if (sample && sample->height_m < halfway && sample->height_m > box_.base_m - box_.step_m()) {
        feet[found++] = sample->height_m;
      }
    }
    return found > kAround / 4 ? median(feet.data(), found) : box_.base_m;
  }

  // Of the pixel that shows a plan position at a height; none where it has no depth.
  std::optional<Sample> sample_at(const Vector2& plan, double height_m) const {
    const Vector3 point = ring_.centre_m + plan.x() * axes_.first + plan.y() * axes_.second + height_m * ring_.normal;
    const auto pixel = project(camera_.intrinsics, point);
    if (!pixel) return std::nullopt;
    const auto u = static_cast<std::int32_t>(std::lround(pixel->x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel->y()));
    if (!frame_.depth.contains(u, v) || !has_depth(frame_.depth.at(u, v))) return std::nullopt;
    return Sample{plane_.height_m(rays_.at(u, v), depth_z_m(camera_, frame_.depth.at(u, v))),
                  static_cast<double>(frame_.intensity.at(u, v))};
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& ring_;
  PlaneAxes axes_;
  DepthPlane plane_;
  const RaisedBox& box_;
};

}  // namespace

TopHeight top_height_of(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& ring,
                        const RaisedBox& box) {
  return TopMeasurer(frame, camera, rays, ring, box).measure();
}

}  // namespace pharos::tof
