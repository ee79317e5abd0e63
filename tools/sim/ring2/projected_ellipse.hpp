// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/sim/random_stream.hpp"
#include "tools/sim/ring2/stereo_rig.hpp"

namespace pharos::sim {

/// An ellipse in the image: centre, semi-axes a >= b, direction of a from +u towards +v in (-pi/2, pi/2].
struct ImageEllipse {
  double cx_px = 0.0;
  double cy_px = 0.0;
  double a_px = 0.0;
  double b_px = 0.0;
  double theta_rad = 0.0;
};

/// Pixel of a point in the rig's frame; empty behind the camera.
std::optional<Vector2> pixel_of(const StereoCamera& camera, const Vector3& point_rig_m);

/// The ellipse that a circle's image is. Without distortion from the homography of its plane, to rounding; with it, the
/// ellipse of least distance to the curve. Empty where a part of the circle is behind the camera.
std::optional<ImageEllipse> projected_ellipse(const StereoCamera& camera, const SpaceCircle& circle);

/// Points of the circle's image, evenly along it, one a pixel or `points` of them.
std::vector<Vector2> contour_points(const StereoCamera& camera, const SpaceCircle& circle, int points = 0);

/// The ellipse of least distance to points: Gauss-Newton from `start` on exact distances to foot points.
ImageEllipse fitted_ellipse(const ImageEllipse& start, std::span<const Vector2> points);

/// What a fit makes of edge points, one a pixel, each off by `sigma_px` (normal) across the contour. `points` receives
/// their number.
std::optional<ImageEllipse> noisy_ellipse(const StereoCamera& camera, const SpaceCircle& circle, double sigma_px,
                                          RandomStream& random, int& points);

}  // namespace pharos::sim
