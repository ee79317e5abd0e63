// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/layer_light.hpp"

#include <array>
#include <cmath>

namespace pharos::tof {
namespace {

constexpr std::uint16_t kFullScale = 65535;
// Variance of an edge's image across, px^2: the filter's 1, pixel and interpolation 0.2, lens 0.25 to 0.5.
constexpr double kBlur_px2 = 1.5;

bool inside(const ImageView<const std::uint16_t>& image, const Vector2& pixel) {
  return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < image.width_px - 1.0 && pixel.y() < image.height_px - 1.0;
}

// 1/z of the plane about a pixel; linear to 0.1 mm over a profile's length.
struct InverseDepth {
  double here;
  double per_u;
  double per_v;

  InverseDepth(const RayGrid& rays, const DepthPlane& plane, const Vector2& pixel) {
    const auto at = [&](double du, double dv) { return 1.0 / plane.z_m(rays.at(pixel.x() + du, pixel.y() + dv)); };
    here = at(0.0, 0.0);
    per_u = 0.25 * (at(2.0, 0.0) - at(-2.0, 0.0));
    per_v = 0.25 * (at(0.0, 2.0) - at(0.0, -2.0));
  }
};

// The four pixels around a place: left and right of the upper row, then of the lower one.
struct Corners {
  std::array<double, 4> light;
  std::array<std::uint16_t, 4> counts;

  Corners(const TofFrame& frame, std::int32_t left, std::int32_t top) {
    const std::uint16_t *upper = frame.intensity.row(top) + left, *lower = upper + frame.intensity.stride_px;
    light = {static_cast<double>(upper[0]), static_cast<double>(upper[1]), static_cast<double>(lower[0]),
             static_cast<double>(lower[1])};
    const std::uint16_t *far_upper = frame.depth.row(top) + left, *far_lower = far_upper + frame.depth.stride_px;
    counts = {far_upper[0], far_upper[1], far_lower[0], far_lower[1]};
  }
  // False where one has light but no depth; what is dark has no light then.
  bool can_be_used(double dark_counts) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (light[k] >= kFullScale) return false;
      if (has_depth(counts[k])) continue;
      if (light[k] > dark_counts) return false;
      light[k] = 0.0;
    }
    return true;
  }
};

}  // namespace

bool sample_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const Vector2& middle, const Vector2& direction, int search_px, double dark_counts,
                  LightProfile& profile) {
  const double reach = search_px + kProfileReach_px;
  if (!inside(frame.intensity, middle - reach * direction) || !inside(frame.intensity, middle + reach * direction)) {
    return false;
  }
  const InverseDepth inverse(rays, plane, middle);
  const double height_unit = 1.0 / plane.q.norm();
  for (int i = 0; i <= 2 * (search_px + kProfileReach_px); ++i) {
    const Vector2 pixel = middle + (i - reach) * direction;
    const auto left = static_cast<std::int32_t>(pixel.x());
    const auto top = static_cast<std::int32_t>(pixel.y());
    const double s = pixel.x() - left;
    const double t = pixel.y() - top;
    Corners corners(frame, left, top);
    if (!corners.can_be_used(dark_counts)) return false;
    const std::array<double, 4> share = {(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t};
    const double first = inverse.here + (left - middle.x()) * inverse.per_u + (top - middle.y()) * inverse.per_v;
    const std::array<double, 4> inverse_z = {first, first + inverse.per_u, first + inverse.per_v,
                                             first + inverse.per_u + inverse.per_v};
    double amplitude = 0.0;
    double moment = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = share[k] * corners.light[k];
      amplitude += weight;
      moment += weight * (1.0 - depth_z_m(camera, corners.counts[k]) * inverse_z[k]);
    }
    profile.amplitude[static_cast<std::size_t>(i)] = amplitude;
    profile.moment[static_cast<std::size_t>(i)] = moment * height_unit;
  }
  return true;
}

std::array<double, kMostSamples> light_of_layer(const LightProfile& profile, int search_px, double face_m,
                                                double foot_m) {
  std::array<double, kMostSamples> light{};
  const double scale = 1.0 / (face_m - foot_m);
  for (std::size_t i = 0; i <= 2U * static_cast<std::size_t>(search_px + kProfileReach_px); ++i) {
    light[i] = scale * (profile.moment[i] - foot_m * profile.amplitude[i]);
  }
  return light;
}

double wall_shift_px(double share, double width_px) {
  if (!(share > 0.0) || !(width_px > 1e-3)) return 0.0;
  return kBlur_px2 * share / ((1.0 - share) * width_px) * -std::expm1(-0.5 * width_px * width_px / kBlur_px2);
}

}  // namespace pharos::tof
