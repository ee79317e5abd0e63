// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "host/images/grey_image.hpp"
#include "pharos/pointing/station.hpp"

namespace pharos::testing {

/// Image of a panel of 10 m x 2 m in a telescope: flat grey, blurred edges, shot noise. No renderer is needed.
struct PaintedPanel {
  PinholeCamera camera{512, 512, 3000.0, 3000.0, 255.5, 255.5, {}};
  pointing::LineOfSight sight{1.0, 0.7};
  double range_m = 100.0;
  Vector3 axis_station = Vector3::UnitX();
  double length_m = 10.0, width_m = 2.0;
  Vector2 shift_m = Vector2::Zero();    ///< to the right and down from the line of sight
  double rim_m = 0.0, rim_light = 1.0;  ///< a strip along its border, of another brightness
  double sky = 600.0, light = 24000.0, noise = 200.0, blur_px = 1.2;

  /// In the image plane turned by `turn_rad`, then out of it.
  void set_axis(double turn_rad, double out_rad) {
    const Matrix3 R = pointing::camera_to_station(sight);
    axis_station = std::cos(out_rad) * (std::cos(turn_rad) * R.col(0) + std::sin(turn_rad) * R.col(1)) +
                   std::sin(out_rad) * R.col(2);
  }

  host::GreyImage image(unsigned seed = 1) const {
    const Corners outer = corners(0.0), inner = corners(rim_m);
    host::GreyImage picture{camera.width_px, camera.height_px, 16, {}};
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        double fraction = rim_light * covered(outer, Vector2(u, v));
        if (rim_light != 1.0) fraction += (1.0 - rim_light) * covered(inner, Vector2(u, v));
        const double value = sky + light * fraction + normal(random);
        picture.pixels.push_back(static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0)));
      }
    }
    return picture;
  }

 private:
  using Corners = std::array<Vector2, 4>;

  // In the image, `inset_m` inside of the border.
  Corners corners(double inset_m) const {
    const Matrix3 R = pointing::camera_to_station(sight);
    const Vector3 axis = R.transpose() * axis_station, side = axis.cross(Vector3(Vector3::UnitZ())).normalized();
    const Vector3 middle(shift_m.x(), shift_m.y(), range_m);
    const std::array<Vector2, 4> places{Vector2(-1, -1), Vector2(1, -1), Vector2(1, 1), Vector2(-1, 1)};
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 p =
          middle + (0.5 * length_m - inset_m) * places[k].x() * axis + (0.5 * width_m - inset_m) * places[k].y() * side;
      corners[k] = {camera.fx_px * p.x() / p.z() + camera.cx_px, camera.fy_px * p.y() / p.z() + camera.cy_px};
    }
    return corners;
  }

  // Blurred.
  double covered(const Corners& corners, const Vector2& pixel) const {
    const Vector2 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    double fraction = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2 along = (corners[(k + 1) % 4] - corners[k]).normalized(), across(-along.y(), along.x());
      const double inward = across.dot(centre - corners[k]) > 0.0 ? 1.0 : -1.0;
      const double off = inward * across.dot(pixel - corners[k]);
      fraction *= 0.5 * std::erfc(-off / (blur_px * std::sqrt(2.0)));
    }
    return fraction;
  }
};

/// A star: a blurred point of light.
inline void add_star(host::GreyImage& image, double u, double v, double light, double sigma_px = 1.2) {
  for (int y = std::max(0, static_cast<int>(v) - 6); y <= std::min(image.height_px - 1, static_cast<int>(v) + 6); ++y) {
    for (int x = std::max(0, static_cast<int>(u) - 6); x <= std::min(image.width_px - 1, static_cast<int>(u) + 6);
         ++x) {
      auto& pixel = image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                                 static_cast<std::size_t>(x)];
      const double more = light * std::exp(-0.5 * ((x - u) * (x - u) + (y - v) * (y - v)) / (sigma_px * sigma_px));
      pixel = static_cast<std::uint16_t>(std::min(65535.0, pixel + more));
    }
  }
}

}  // namespace pharos::testing
