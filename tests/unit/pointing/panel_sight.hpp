// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "pharos/pointing/line_fit.hpp"
#include "pharos/pointing/station.hpp"

namespace pharos::pointing {

/// A panel of 10 m x 2 m seen by a telescope: its long edges as points with noise, from its corners in space.
struct PanelSight {
  PinholeCamera camera{1024, 1024, 6000.0, 6000.0, 511.5, 511.5, {}};
  LineOfSight sight{1.2, 0.6};
  double range_m = 100.0;
  Vector3 axis_station = Vector3::UnitX();
  Vector3 across_station = Vector3::UnitY();
  double length_m = 10.0, width_m = 2.0;
  double noise_px = 0.1;

  /// Looks at the axis `out_of_image_rad` out of the image plane, turned in the image by `turn_rad`, the panel square
  /// on.
  void set_axis(double turn_rad, double out_of_image_rad) {
    const Matrix3 R = camera_to_station(sight);
    const Vector3 in_image = std::cos(turn_rad) * R.col(0) + std::sin(turn_rad) * R.col(1);
    axis_station = std::cos(out_of_image_rad) * in_image + std::sin(out_of_image_rad) * R.col(2);
    across_station = axis_station.cross(R.col(2)).normalized();
  }

  /// Points a pixel apart along the edge at side -1 or +1.
  template <class Random>
  std::vector<EdgePoint> edge(double side, Random& random) const {
    const Vector3 middle = range_m * direction_station(sight) + 0.5 * side * width_m * across_station;
    const Matrix3 R_camera_station = camera_to_station(sight).transpose();
    const auto seen = [&](double along_m) {
      return *project(camera, R_camera_station * (middle + along_m * axis_station));
    };
    const Vector2 from = seen(-0.5 * length_m), to = seen(0.5 * length_m), along = (to - from).normalized();
    const int count = std::max(12, static_cast<int>((to - from).norm()));
    std::normal_distribution<double> noise(0.0, noise_px);
    std::vector<EdgePoint> points;
    for (int k = 0; k < count; ++k) {
      EdgePoint point;
      point.place_px = seen(length_m * ((k + 0.5) / count - 0.5)) + noise(random) * Vector2(-along.y(), along.x());
      points.push_back(point);
    }
    return points;
  }

  /// The planes of both long edges in S.
  template <class Random>
  AxisPlanes planes(Random& random) const {
    AxisPlanes result;
    for (const double side : {-1.0, 1.0}) {
      std::vector<EdgePoint> points = edge(side, random);
      if (!undo_distortion(points, camera)) continue;
      const auto fit = fit_line(points);
      if (fit) result.push_back(rotated(plane_of_line(fit->line, camera), camera_to_station(sight)));
    }
    return result;
  }
};

}  // namespace pharos::pointing
