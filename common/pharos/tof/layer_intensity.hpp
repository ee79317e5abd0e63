// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/depth_plane.hpp"
#include "pharos/tof/image_profile.hpp"

namespace pharos::tof {

/// Amplitude and height over a plane along a profile. Both are linear in the light that a pixel collects (depths mix
/// weighted by amplitude), so that they may be interpolated and blurred.
struct LightProfile {
  std::array<double, kMaxSamples> amplitude{};
  std::array<double, kMaxSamples> moment{};  ///< amplitude x height, counts m
};

/// Samples of 1 px along `direction` (unit), 2 (search_px + kProfileReach_px) + 1 of them about `middle`. Dark pixels
/// without depth count as no light. False where the profile leaves the image, or where a pixel has light (more than
/// `dark_counts`, or all that it holds) but no depth, and its neighbours do not tell it (mixed_pixel.hpp).
bool sample_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const Vector2& middle, const Vector2& direction, int search_px, double dark_counts,
                  LightProfile& profile);

/// The amplitude that comes from a layer at `face_m`, where the rest comes from `base_m`: amplitude (h - base) / (face
/// - base). What the base reflects, glinting foil for example, has no influence: an edge of this intensity is the
/// layer's own, whichever side is brighter.
std::array<double, kMaxSamples> light_of_layer(const LightProfile& profile, int search_px, double face_m,
                                               double base_m);

/// A wall as bright as this fraction of the layer leaves no usable edge.
inline constexpr double kBrightWall = 0.5;

/// Shift of the steepest point of the layer's intensity outwards, px, by an upright wall in sight beyond the layer's
/// edge. `fraction`: the wall's amplitude over the layer's, up to kBrightWall; its part in the layer's intensity falls
/// to zero at its base, `width_px` away. There (1 - fraction) of the edge's bell falls as fast as fraction / width of
/// the ramp's step grows.
double wall_shift_px(double fraction, double width_px);

}  // namespace pharos::tof
