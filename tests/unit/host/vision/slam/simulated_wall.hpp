// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "host/vision/slam/pyramid.hpp"
#include "simulated_views.hpp"

namespace pharos::slam::test {

/// A plane with smoothly varying brightness, seen by kCamera.
struct Wall {
  Vector3 normal{0.3, -0.2, -1.0};  // in the target's frame
  double offset_m = 0.0;
  double contrast = 50.0, brightness = 120.0;
  Vector2 light_slope = Vector2::Zero();  // grey values a pixel, within 40 px of the image's middle

  Vector3 hit(const CameraFromTarget& pose, const Vector2& pixel) const {
    const auto T_target_camera = pose.inverse();
    const Vector3 ray = T_target_camera.R * kCamera.back_project(pixel, 1.0);
    return T_target_camera.t + ray * ((offset_m - normal.dot(T_target_camera.t)) / normal.dot(ray));
  }
  std::vector<std::uint8_t> seen(const CameraFromTarget& pose) const {
    std::vector<std::uint8_t> image;
    for (int v = 0; v < kCamera.height_px; ++v) {
      for (int u = 0; u < kCamera.width_px; ++u) {
        const Vector3 p = hit(pose, Vector2(u, v));
        const double light = std::sin(60.0 * p.x()) + std::cos(70.0 * p.y() + 20.0 * p.x());
        const Vector2 off(std::clamp(u - kCamera.cx_px, -40.0, 40.0), std::clamp(v - kCamera.cy_px, -40.0, 40.0));
        const double grey = brightness + contrast * light + light_slope.dot(off);
        image.push_back(static_cast<std::uint8_t>(std::lround(grey)));
      }
    }
    return image;
  }
  Feature feature(const CameraFromTarget& pose, const Vector2& pixel) const {
    const auto disparity = [&](const Vector2& at) {
      return kCamera.fx_px * kCamera.baseline_m / (pose * hit(pose, at)).z();
    };
    Feature out;
    out.pixel = pixel;
    out.right_u_px = pixel.x() - disparity(pixel);
    out.depth_m = kCamera.depth_m(disparity(pixel));
    out.disparity_slope = {disparity(pixel + Vector2(1.0, 0.0)) - disparity(pixel),
                           disparity(pixel + Vector2(0.0, 1.0)) - disparity(pixel)};
    return out;
  }
};

inline std::vector<PyramidLevel> pyramid_of(const std::vector<std::uint8_t>& image) {
  return {{{image.data(), kCamera.width_px, kCamera.height_px}}};
}

}  // namespace pharos::slam::test
