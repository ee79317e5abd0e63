// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pharos/tof/constants.hpp"
#include "pharos/tof/ellipse_rows.hpp"
#include "pharos/tof/ring_extent.hpp"

namespace pharos::tof {
namespace {

// From here on, beyond edge or foot, the surroundings' height and light are taken.
constexpr double kBehind_px = 2.5;
constexpr double kLightReach_px = 6.0;
// The depth of what lies behind where a wall hides it: this quantile of what is seen elsewhere.
constexpr double kBehindQuantile = 0.7;
// A pixel darker than this fraction of the ring and without depth is dark background.
constexpr double kNoLight = 0.3;
constexpr std::size_t kMinGathered = 200;

// Directions are counted along a diamond's perimeter: no angle is needed.
std::size_t direction_of(double x, double y) {
  const double size = std::fabs(x) + std::fabs(y);
  if (!(size > 0.0)) return 0;
  const double diamond = y >= 0.0 ? 1.0 - x / size : 3.0 + x / size;
  return std::min(kRingDirections - 1, static_cast<std::size_t>(diamond * (kRingDirections / 4.0)));
}
Vector2 middle_of(std::size_t direction) {
  const double diamond = (static_cast<double>(direction) + 0.5) * 4.0 / static_cast<double>(kRingDirections);
  const bool upper = diamond < 2.0;
  const double x = upper ? 1.0 - diamond : diamond - 3.0;
  return Vector2(x, upper ? 1.0 - std::fabs(x) : std::fabs(x) - 1.0).normalized();
}

class Gatherer {
 public:
  Gatherer(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
           const RingPrior& prior, RingPixels& workspace)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        model_(model),
        plane_(model.plane()),
        axes_(axes_of(model.normal)),
        prior_(prior),
        work_(workspace) {}

  bool gather() {
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      if (!place_direction(k)) return false;
    }
    if (!take_pixels()) return false;
    sort_pixels();
    take_surroundings();
    return true;
  }

 private:
  bool place_direction(std::size_t k) {
    RingDirection& one = work_.directions[k];
    one.plan = middle_of(k);
    const Vector3 outwards = one.plan.x() * axes_.first + one.plan.y() * axes_.second;
    for (const RingEdge edge : kRingEdges) {
      const std::size_t e = index_of(edge);
      const Vector3 point = model_.centre_m + model_.radius(edge) * outwards;
      if (!project(camera_.intrinsics, point)) return false;
      const Matrix23 slope = project_jacobian(camera_.intrinsics, point);
      const Vector2 tangent = slope * (-one.plan.y() * axes_.first + one.plan.x() * axes_.second);
      Vector2 normal = Vector2(tangent.y(), -tangent.x()).normalized();
      if (normal.dot(slope * outwards) < 0.0) normal = -normal;
      one.row[e] = edge_row(camera_, model_, axes_, point, normal, edge);
      one.per_m[e] = one.row[e][5 + static_cast<int>(e)];
      const double away = edge == RingEdge::kOuter ? 1.0 : -1.0;
      // The outer wall faces away from the axis, the inner one towards it; the camera is at the origin.
      one.wall[e] = std::max(0.0, away * point.dot(outwards) / point.dot(model_.normal));
      depth_px_[e][k] = one.wall[e] > 0.0 ? std::fabs((slope * model_.normal).dot(normal)) : 0.0;
      one.foot_px[e] = one.base_m[e] = one.base_light[e] = 0.0;
    }
    one.width_px = (model_.radius_m[0] - model_.radius_m[1]) * one.per_m[1];
    one.inner_scale = one.per_m[1] / one.per_m[0];
    one.seen = on_plane(frame_, camera_, model_.centre_m + 0.5 * (model_.radius_m[0] + model_.radius_m[1]) * outwards,
                        prior_.depth_gate_m);
    return one.per_m[0] > 0.0 && one.per_m[1] > 0.0;
  }

  // Everything within reach of the ring, by rows; of a large image every second, third, ... row.
  bool take_pixels() {
    const auto outer = image_of(model_, RingEdge::kOuter, camera_.intrinsics);
    const auto inner = image_of(model_, RingEdge::kInner, camera_.intrinsics);
    if (!outer || !inner) return false;
    const double reach = 2.0 * kLightReach_px;
    const EllipseRows out(*outer, reach), in(*inner, -reach);
    std::size_t count = 0;
    for_each_span_between(in, out, frame_.depth.width_px, frame_.depth.height_px, [&](std::int32_t, PixelSpan span) {
      count += static_cast<std::size_t>(span.last - span.first + 1);
    });
    const auto every = static_cast<std::int32_t>(1 + count / kMaxRingPixels);
    work_.pixels.clear();
    RayGrid::Row<double> rays;
    for_each_span_between(in, out, frame_.depth.width_px, frame_.depth.height_px, [&](std::int32_t v, PixelSpan span) {
      if (v % every != 0) return;
      rays_.row_at(span.first, v, span.last - span.first + 1, rays);
      for (std::int32_t u = span.first; u <= span.last; ++u) {
        take_pixel(u, v, {rays.x()[u - span.first], rays.y()[u - span.first]});
      }
    });
    return work_.pixels.size() >= kMinGathered;
  }

  void take_pixel(std::int32_t u, std::int32_t v, const Vector2& ray) {
    const std::uint16_t counts = frame_.depth.at(u, v), light = frame_.intensity.at(u, v);
    if (light == kFullScale) return;
    const double z = plane_.z_m(ray);
    const Vector3 arm = z * Vector3(ray.x(), ray.y(), 1.0) - model_.centre_m;
    const double x = axes_.first.dot(arm), y = axes_.second.dot(arm);
    const std::size_t k = direction_of(x, y);
    const RingDirection& one = work_.directions[k];
    if (!one.seen) return;
    double height = 0.0;
    std::uint16_t bright = light;
    if (has_depth(counts)) {
      height = plane_.height_m(ray, depth_z_m(camera_, counts));
      if (height > prior_.depth_gate_m) return;  // something before the ring
    } else {
      if (light > kNoLight * prior_.amplitude) return;
      bright = 0;
    }
    const double r = std::sqrt(x * x + y * y);
    (void)work_.pixels.push_back({static_cast<float>((r - model_.radius_m[0]) * one.per_m[0]),
                                  static_cast<float>(height), bright, static_cast<std::uint16_t>(k)});
  }

  void sort_pixels() {
    work_.begin.fill(0);
    for (const RingPixel& pixel : work_.pixels) ++work_.begin[pixel.direction + 1U];
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      work_.begin[k + 1] = static_cast<std::uint16_t>(work_.begin[k + 1] + work_.begin[k]);
    }
    // In place: whatever lies in a direction's part goes to its own, until one of this direction comes.
    std::array<std::uint16_t, kRingDirections> next;
    std::copy_n(work_.begin.begin(), kRingDirections, next.begin());
    for (std::size_t k = 0; k < kRingDirections; ++k) {
      while (next[k] < work_.begin[k + 1]) {
        RingPixel& pixel = work_.pixels[next[k]];
        std::swap(pixel, work_.pixels[next[pixel.direction]++]);
      }
    }
  }

  // Height and light behind either edge: first without walls, for their feet; then beyond these.
  void take_surroundings() {
    std::array<double, 2 * kRingSectors> depths{};
    for (int pass = 0; pass < 2; ++pass) {
      std::array<std::array<double, kRingSectors>, 2> light{}, moment{};
      std::array<std::array<int, kRingSectors>, 2> count{};
      for (std::size_t k = 0; k < kRingDirections; ++k) {
        const RingDirection& one = work_.directions[k];
        const std::size_t s = k / kDirectionsTogether;
        for (const RingPixel& pixel : work_.of(k)) {
          for (std::size_t e = 0; e < 2; ++e) {
            const double away = one.beyond_px(static_cast<double>(pixel.beyond_outer_px), e) - one.foot_px[e];
            if (away < kBehind_px || away > kLightReach_px) continue;
            light[e][s] += static_cast<double>(pixel.light);
            moment[e][s] += static_cast<double>(pixel.light) * static_cast<double>(pixel.height_m);
            ++count[e][s];
          }
        }
      }
      std::size_t known = 0;
      for (std::size_t e = 0; e < 2; ++e) {
        for (std::size_t s = 0; s < kRingSectors; ++s) {
          const double base = light[e][s] > 0.0 ? moment[e][s] / light[e][s] : 0.0;
          if (base < -prior_.min_step_m) depths[known++] = -base;
          for (std::size_t k = s * kDirectionsTogether; k < (s + 1) * kDirectionsTogether; ++k) {
            work_.directions[k].base_m[e] = base;
            work_.directions[k].base_light[e] = count[e][s] > 0 ? light[e][s] / count[e][s] : 0.0;
          }
        }
      }
      if (known == 0) return;
      const auto place = depths.begin() + static_cast<std::ptrdiff_t>(kBehindQuantile * static_cast<double>(known - 1));
      std::nth_element(depths.begin(), place, depths.begin() + static_cast<std::ptrdiff_t>(known));
      work_.base_m = *place;
      for (std::size_t k = 0; k < kRingDirections; ++k) {
        for (std::size_t e = 0; e < 2; ++e) work_.directions[k].foot_px[e] = depth_px_[e][k] * work_.base_m;
      }
    }
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& model_;
  DepthPlane plane_;
  PlaneAxes axes_;
  const RingPrior& prior_;
  RingPixels& work_;
  std::array<std::array<double, kRingDirections>, 2> depth_px_{};  // image of a wall, px per metre of its depth
};

}  // namespace

bool gather_ring_pixels(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                        const RingPrior& prior, RingPixels& pixels) {
  return Gatherer(frame, camera, rays, model, prior, pixels).gather();
}

}  // namespace pharos::tof
