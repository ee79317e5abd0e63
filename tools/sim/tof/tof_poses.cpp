// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/tof_poses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::sim {
namespace {

constexpr int kMaxDraws = 10'000;
constexpr double kFullTurn_deg = 360.0;

Matrix3 about(const Vector3& axis, double angle_rad) { return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix(); }

// The points that must be in the picture.
std::vector<Vector3> outline(const Satellite& satellite) {
  constexpr int kPoints = 24;
  std::vector<Vector3> points;
  const double radius = satellite.ring     ? satellite.ring->outer_radius_m
                        : satellite.nozzle ? satellite.nozzle->exit_radius_m
                                           : 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  for (const Connector& c : satellite.connectors) {
    const Matrix3 turn = about(Vector3::UnitZ(), c.direction_deg * kRadPerDeg);
    for (const double across : {-0.5, 0.5}) {
      for (const double along : {-0.5, 0.5}) {
        points.push_back(turn * Vector3(c.distance_m + across * c.side_m, along * c.side_m, satellite.face_z_m));
      }
    }
  }
  return points;
}

bool in_picture(const std::vector<Vector3>& points, const CameraFromTarget& pose, const PixelRays& rays,
                double margin_px) {
  return std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
    const Vector3 p = pose * point;
    if (p.z() <= 0.0) return false;
    const Vector2 pixel = rays.project(p);
    return pixel.x() > margin_px && pixel.y() > margin_px && pixel.x() < rays.lens().width_px - 1 - margin_px &&
           pixel.y() < rays.lens().height_px - 1 - margin_px;
  });
}

CameraFromTarget draw(const RandomPoses& limits, const PixelRays& rays, RandomStream& random) {
  const int u = random.below(rays.lens().width_px);
  const int v = random.below(rays.lens().height_px);
  const Vector3 sight = Vector3(rays.ray(u, v).x(), rays.ray(u, v).y(), 1.0).normalized();
  CameraFromTarget pose;
  pose.t = sight * random.uniform(limits.min_range_m, limits.max_range_m);
  // Facing along the line of sight, turned about it, then tilted about a random axis square to it.
  const Matrix3 facing = rotation_between(Vector3::UnitZ(), sight) * Vector3(1.0, -1.0, -1.0).asDiagonal();
  const double heading = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Vector3 axis = facing * Vector3(std::cos(heading), std::sin(heading), 0.0);
  pose.R = about(axis, random.uniform(0.0, limits.max_tilt_deg) * kRadPerDeg) * facing *
           about(Vector3::UnitZ(), random.uniform(0.0, kFullTurn_deg) * kRadPerDeg);
  return pose;
}

}  // namespace

Matrix3 attitude_of(const PaperAngles& angles) {
  return Vector3(1.0, -1.0, -1.0).asDiagonal() * (about(Vector3::UnitX(), angles.alpha_deg * kRadPerDeg) *
                                                  about(Vector3::UnitY(), angles.beta_deg * kRadPerDeg) *
                                                  about(Vector3::UnitZ(), angles.gamma_deg * kRadPerDeg));
}

PaperAngles angles_of(const Matrix3& R_camera_target) {
  const Matrix3 R = Vector3(1.0, -1.0, -1.0).asDiagonal() * R_camera_target;
  return {std::atan2(-R(1, 2), R(2, 2)) / kRadPerDeg, std::asin(std::clamp(R(0, 2), -1.0, 1.0)) / kRadPerDeg,
          std::atan2(-R(0, 1), R(0, 0)) / kRadPerDeg};
}

std::vector<CameraFromTarget> random_poses(const RandomPoses& limits, const Satellite& satellite, const PixelRays& rays,
                                           RandomStream random) {
  const std::vector<Vector3> points = outline(satellite);
  std::vector<CameraFromTarget> poses;
  for (int i = 0; i < limits.count; ++i) {
    int draws = 0;
    CameraFromTarget pose = draw(limits, rays, random);
    while (!in_picture(points, pose, rays, limits.margin_px)) {
      if (++draws == kMaxDraws) {
        throw host::InputError("trajectory: min_range_m: no random pose keeps the ring in the picture; raise it");
      }
      pose = draw(limits, rays, random);
    }
    poses.push_back(pose);
  }
  return poses;
}

CameraFromTarget Approach::at(double time_s) const {
  const double part = duration_s > 0.0 ? std::clamp(time_s / duration_s, 0.0, 1.0) : 1.0;
  CameraFromTarget pose;
  pose.t = from.t + part * (to.t - from.t);
  const double nod_rad = nod_deg * kRadPerDeg * std::sin(2.0 * std::numbers::pi * time_s / nod_period_s);
  pose.R = Quaternion(from.R).slerp(part, Quaternion(to.R)).toRotationMatrix() * about(Vector3::UnitX(), nod_rad) *
           about(Vector3::UnitZ(), spin_deg_s * kRadPerDeg * time_s);
  return pose;
}

}  // namespace pharos::sim
