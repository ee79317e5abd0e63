// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/layer_intensity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/tof/constants.hpp"
#include "pharos/tof/mixed_pixel.hpp"

namespace pharos::tof {
namespace {

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

// Of each sample, so that compilers take two at a time.
using PerSample = std::array<double, kMaxSamples>;
// The four pixels around a point: left and right of the upper row, then of the lower one.
constexpr std::size_t kCorners = 4;

// Positions of the samples, and the values of their corners.
struct Places {
  std::array<std::int32_t, kMaxSamples> left, top;
  PerSample s, t;       // of the way to the right, and down
  PerSample inverse_z;  // of the plane, at the left upper corner
  std::array<PerSample, kCorners> light, counts;
};

void take_places(const InverseDepth& inverse, const Vector2& middle, const Vector2& direction, double reach,
                 std::size_t count, Places& places) {
  const double middle_u = middle.x(), middle_v = middle.y(), step_u = direction.x(), step_v = direction.y();
  const double here = inverse.here, per_u = inverse.per_u, per_v = inverse.per_v;
  for (std::size_t i = 0; i < count; ++i) {
    const double way = static_cast<double>(static_cast<std::int32_t>(i)) - reach;
    const double u = middle_u + way * step_u, v = middle_v + way * step_v;
    const auto left = static_cast<std::int32_t>(u), top = static_cast<std::int32_t>(v);
    places.left[i] = left;
    places.top[i] = top;
    places.s[i] = u - left;
    places.t[i] = v - top;
    places.inverse_z[i] = here + (left - middle_u) * per_u + (top - middle_v) * per_v;
  }
}

// Depths over the plane's, less 1, of a pixel: linear in its height.
struct OverPlane {
  const TofFrame& frame;
  const DepthCamera& camera;
  const InverseDepth& inverse;
  const Vector2& middle;

  double inverse_z(std::int32_t u, std::int32_t v) const {
    return inverse.here + (u - middle.x()) * inverse.per_u + (v - middle.y()) * inverse.per_v;
  }
  double operator()(std::int32_t u, std::int32_t v) const {
    return depth_z_m(camera, frame.depth.at(u, v)) * inverse_z(u, v) - 1.0;
  }
  // The depth, in counts, of a pixel that is so far over the plane.
  double counts_of(std::int32_t u, std::int32_t v, double over) const {
    return ((over + 1.0) / inverse_z(u, v) - camera.depth_origin_z_m) / camera.depth_scale_m;
  }
};

// False where a pixel has light but no depth, and its neighbours do not tell it; a dark one counts as no light.
bool take_corners(const TofFrame& frame, const OverPlane& over, const Vector2& direction, double dark_counts,
                  std::size_t count, Places& places) {
  const auto dark = static_cast<std::int32_t>(std::clamp(std::floor(dark_counts), -1.0, double{kFullScale}));
  bool usable = true;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t* light = frame.intensity.row(places.top[i]) + places.left[i];
    const std::uint16_t* counts = frame.depth.row(places.top[i]) + places.left[i];
    const auto take = [&](std::size_t corner, std::uint16_t bright, std::uint16_t far) {
      const bool seen = has_depth(far);
      places.light[corner][i] = seen ? bright : 0;
      places.counts[corner][i] = far;
      usable = usable && bright != kFullScale;
      if (seen || bright <= dark || !usable) return;
      const std::int32_t u = places.left[i] + static_cast<std::int32_t>(corner % 2);
      const std::int32_t v = places.top[i] + static_cast<std::int32_t>(corner / 2);
      const auto mixed = mixed_height(frame, u, v, direction, over);
      usable = mixed.has_value();
      if (!mixed) return;
      places.light[corner][i] = bright;
      places.counts[corner][i] = over.counts_of(u, v, *mixed);
    };
    take(0, light[0], counts[0]);
    take(1, light[1], counts[1]);
    take(2, light[frame.intensity.stride_px], counts[frame.depth.stride_px]);
    take(3, light[frame.intensity.stride_px + 1], counts[frame.depth.stride_px + 1]);
    if (!usable) return false;
  }
  return true;
}

// Amplitude and moment of all samples, between their corners.
void sum_corners(const DepthCamera& camera, const InverseDepth& inverse, double height_unit, std::size_t count,
                 const Places& places, LightProfile& profile) {
  const double scale = camera.depth_scale_m, origin = camera.depth_origin_z_m;
  const double per_u = inverse.per_u, per_v = inverse.per_v;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = places.s[i], t = places.t[i], first = places.inverse_z[i];
    const std::array<double, kCorners> fraction = {(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t};
    const std::array<double, kCorners> inverse_z = {first, first + per_u, first + per_v, first + per_u + per_v};
    double amplitude = 0.0;
    double moment = 0.0;
    for (std::size_t k = 0; k < kCorners; ++k) {
      const double weight = fraction[k] * places.light[k][i];
      amplitude += weight;
      moment += weight * (1.0 - (places.counts[k][i] * scale + origin) * inverse_z[k]);
    }
    profile.amplitude[i] = amplitude;
    profile.moment[i] = moment * height_unit;
  }
}

}  // namespace

bool sample_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const Vector2& middle, const Vector2& direction, int search_px, double dark_counts,
                  LightProfile& profile) {
  const double reach = search_px + kProfileReach_px;
  if (!inside(frame.intensity, middle - reach * direction) || !inside(frame.intensity, middle + reach * direction)) {
    return false;
  }
  const InverseDepth inverse(rays, plane, middle);
  const std::size_t count = 2U * static_cast<std::size_t>(search_px + kProfileReach_px) + 1U;
  Places places;
  take_places(inverse, middle, direction, reach, count, places);
  const OverPlane over{frame, camera, inverse, middle};
  if (!take_corners(frame, over, direction, dark_counts, count, places)) return false;
  sum_corners(camera, inverse, 1.0 / plane.q.norm(), count, places, profile);
  return true;
}

std::array<double, kMaxSamples> light_of_layer(const LightProfile& profile, int search_px, double face_m,
                                               double base_m) {
  std::array<double, kMaxSamples> light{};
  const double scale = 1.0 / (face_m - base_m);
  for (std::size_t i = 0; i <= 2U * static_cast<std::size_t>(search_px + kProfileReach_px); ++i) {
    light[i] = scale * (profile.moment[i] - base_m * profile.amplitude[i]);
  }
  return light;
}

double wall_shift_px(double fraction, double width_px) {
  if (!(fraction > 0.0) || !(width_px > 1e-3)) return 0.0;
  return kBlur_px2 * fraction / ((1.0 - fraction) * width_px) * -std::expm1(-0.5 * width_px * width_px / kBlur_px2);
}

}  // namespace pharos::tof
