// SPDX-License-Identifier: Apache-2.0
// Sections 2.2, 2.3 and 3.2 of paper 003: planes, their intersection, the target's body frame.
#include <cmath>

#include "tools/pointing/paper/paper_line.hpp"

namespace pharos::tools::paper003 {
namespace {

// (8): rows image right, image down, optical axis in the station's frame (east, north, up), the image upright.
Matrix3 camera_from_station(double azimuth_rad, double elevation_rad) {
  const double sa = std::sin(azimuth_rad), ca = std::cos(azimuth_rad);
  const double se = std::sin(elevation_rad), ce = std::cos(elevation_rad);
  Matrix3 R;
  R << ca, -sa, 0.0,          //
      se * sa, se * ca, -ce,  //
      ce * sa, ce * ca, se;
  return R;
}

// (11), (12): the direction of the line in which two planes meet.
std::optional<Vector3> intersection(const Vector3& one, const Vector3& other) {
  constexpr double kOnePlane = 1e-12;
  const Vector3 direction(one.y() * other.z() - other.y() * one.z(), one.z() * other.x() - other.z() * one.x(),
                          one.x() * other.y() - other.x() * one.y());
  if (direction.norm() < kOnePlane * one.norm() * other.norm()) return std::nullopt;
  return direction.normalized();
}

}  // namespace

std::string_view name_of(Failure failure) {
  switch (failure) {
    case Failure::kNoContrast:
      return "no_contrast";
    case Failure::kNoEdges:
      return "no_edges";
    case Failure::kParallelPlanes:
      return "parallel_planes";
  }
  return "";
}

Vector3 plane_of(const LineSegment& edge, const PinholeCamera& camera, const Matrix3& R) {
  // (9): a u + b v + c = 0 through both end points.
  const double a = edge.begin.y() - edge.end.y();
  const double b = edge.end.x() - edge.begin.x();
  const double c = -a * edge.begin.x() - b * edge.begin.y();
  const double f = 0.5 * (camera.fx_px + camera.fy_px);
  // (10): A, B, C.
  Vector3 normal;
  for (int k = 0; k < 3; ++k) {
    normal[k] =
        a * f * R(0, k) + a * camera.cx_px * R(2, k) + b * f * R(1, k) + b * camera.cy_px * R(2, k) + c * R(2, k);
  }
  return normal;
}

Matrix3 body_from_station(double pitch_rad, double yaw_rad) {
  const double sp = std::sin(pitch_rad), cp = std::cos(pitch_rad);
  const double sy = std::sin(yaw_rad), cy = std::cos(yaw_rad);
  Matrix3 M;
  M << cp * sy, cp * cy, sp,  //
      cy, -sy, 0.0,           //
      sp * sy, sp * cy, -cp;
  return M;
}

Result<Axis, Failure> axis_of(const Stages& stages, const PinholeCamera& camera, double azimuth_rad,
                              double elevation_rad) {
  if (!stages.found) return Failure::kNoEdges;
  const Matrix3 R = camera_from_station(azimuth_rad, elevation_rad);
  const auto along = intersection(plane_of(stages.long_edges[0], camera, R), plane_of(stages.long_edges[1], camera, R));
  if (!along) return Failure::kParallelPlanes;
  Axis axis;
  axis.direction_station = *along;
  axis.pitch_rad = std::atan2(along->z(), std::hypot(along->x(), along->y()));
  axis.yaw_rad = std::atan2(along->x(), along->y());
  if (stages.short_edges.size() == 2) {
    const auto across =
        intersection(plane_of(stages.short_edges[0], camera, R), plane_of(stages.short_edges[1], camera, R));
    if (across) axis.square_rad = std::acos((body_from_station(axis.pitch_rad, axis.yaw_rad) * *across).x());
  }
  return axis;
}

}  // namespace pharos::tools::paper003
