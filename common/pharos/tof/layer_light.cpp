// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/layer_light.hpp"

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
    double amplitude = 0.0;
    double moment = 0.0;
    for (std::int32_t corner = 0; corner < 4; ++corner) {
      const std::int32_t u = left + (corner & 1);
      const std::int32_t v = top + (corner >> 1);
      const std::uint16_t light = frame.intensity.at(u, v);
      const std::uint16_t counts = frame.depth.at(u, v);
      if (light == kFullScale) return false;
      if (!has_depth(counts)) {
        if (light > dark_counts) return false;
        continue;
      }
      const double weight = ((corner & 1) != 0 ? s : 1.0 - s) * ((corner >> 1) != 0 ? t : 1.0 - t) * light;
      const double inverse_z = inverse.here + (u - middle.x()) * inverse.per_u + (v - middle.y()) * inverse.per_v;
      amplitude += weight;
      moment += weight * (1.0 - depth_z_m(camera, counts) * inverse_z) * height_unit;
    }
    profile.amplitude[static_cast<std::size_t>(i)] = amplitude;
    profile.moment[static_cast<std::size_t>(i)] = moment;
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
