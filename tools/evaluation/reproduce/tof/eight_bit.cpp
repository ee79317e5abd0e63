// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/eight_bit.hpp"

#include <cmath>
#include <numbers>
#include <span>

#include "pharos/geometry/symmetric.hpp"
#include "pharos/tof/ring_extent.hpp"
#include "tools/tof/paper/paper_chain.hpp"

namespace pharos::tools {
namespace {

ellipse::Ellipse mean_of(const ellipse::Ellipse& one, const ellipse::Ellipse& other) {
  ellipse::Ellipse mean = one;
  mean.cx_px = 0.5 * (one.cx_px + other.cx_px);
  mean.cy_px = 0.5 * (one.cy_px + other.cy_px);
  mean.a_px = 0.5 * (one.a_px + other.a_px);
  mean.b_px = 0.5 * (one.b_px + other.b_px);
  // The axis has no sign: the mean of two that differ by half a turn is either.
  mean.theta_rad += 0.5 * std::remainder(other.theta_rad - one.theta_rad, std::numbers::pi);
  return mean;
}

// The detected ellipse that is this edge of the ring; the edge's own image where none is: the ring was found by another
// edge then (its wall's foot), or by depth.
std::optional<ellipse::Ellipse> ellipse_of(const tof::RingModel& model, tof::RingEdge edge, const DepthCamera& camera,
                                           std::span<const ellipse::DetectedEllipse> found) {
  constexpr double kSame_px = 1.0;
  const auto image = tof::image_of(model, edge, camera.intrinsics);
  if (!image) return std::nullopt;
  for (const ellipse::DetectedEllipse& one : found) {
    const ellipse::Ellipse& e = one.ellipse;
    if (std::hypot(e.cx_px - image->cx_px, e.cy_px - image->cy_px) < kSame_px &&
        std::abs(e.a_px - image->a_px) < kSame_px && std::abs(e.b_px - image->b_px) < kSame_px) {
      return e;
    }
  }
  return image;
}

// The point that the pixel's depth says, frame C.
std::optional<Vector3> point_at(const sim::TofPixels& pixels, const DepthCamera& camera, const Vector2& pixel) {
  const auto u = std::lround(pixel.x());
  const auto v = std::lround(pixel.y());
  if (u < 0 || v < 0 || u >= pixels.width_px || v >= pixels.height_px) return std::nullopt;
  const std::uint16_t counts = pixels.depth[static_cast<std::size_t>(v * pixels.width_px + u)];
  const Result<Vector2, CameraFailure> ray = undistort(camera.intrinsics, pixel);
  if (!has_depth(counts) || !ray) return std::nullopt;
  return depth_z_m(camera, counts) * Vector3(ray->x(), ray->y(), 1.0);
}

}  // namespace

sim::TofPixels eight_bit_frame(const sim::TofPixels& pixels, const DepthCamera& camera) {
  sim::TofPixels result = pixels;
  result.depth = paper000::eight_bit_depth({pixels.depth.data(), pixels.width_px, pixels.height_px}, camera);
  return result;
}

std::optional<tof::CameraFromTarget> paper_pose(const sim::TofPixels& pixels, const DepthCamera& camera,
                                                const tof::TofPose& seen, const tof::TofWorkspace& workspace) {
  const tof::ConnectorWorkspace& regions = workspace.connector;
  const std::span<const ellipse::DetectedEllipse> found(workspace.ellipse.found.data(), workspace.ellipse.found.size());
  const auto outer = ellipse_of(seen.ring.fit.model, tof::RingEdge::kOuter, camera, found);
  const auto inner = ellipse_of(seen.ring.fit.model, tof::RingEdge::kInner, camera, found);
  if (regions.connectors.empty() || !outer || !inner) return std::nullopt;
  const ellipse::Ellipse ring = mean_of(*outer, *inner);
  // The plane z = p . (x/z, y/z, 1)^-1 is linear in inverse depth: 1/z = q . ray.
  Matrix3 normal = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  for (int i = 0; i < kRingPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kRingPoints;
    const double along = ring.a_px * std::cos(turn);
    const double across = ring.b_px * std::sin(turn);
    const double c = std::cos(ring.theta_rad);
    const double s = std::sin(ring.theta_rad);
    const Vector2 pixel(ring.cx_px + c * along - s * across, ring.cy_px + s * along + c * across);
    const std::optional<Vector3> point = point_at(pixels, camera, pixel);
    if (!point) return std::nullopt;
    normal += *point * point->transpose();
    right += *point;
  }
  const Vector3 q = solve_symmetric<3>(normal, right);  // q . point = 1
  const Result<Vector2, CameraFailure> centre_ray = undistort(camera.intrinsics, {ring.cx_px, ring.cy_px});
  if (!centre_ray) return std::nullopt;
  const Vector3 sight(centre_ray->x(), centre_ray->y(), 1.0);

  const tof::RegionReport& region = regions.connectors[0];
  const tof::RingModel& model = seen.ring.fit.model;
  const tof::PlaneAxes axes = tof::axes_of(model.normal);
  const Result<Vector2, CameraFailure> middle =
      project(camera.intrinsics, model.centre_m + region.rectangle.centre_m.x() * axes.first +
                                     region.rectangle.centre_m.y() * axes.second + region.height_m * model.normal);
  if (!middle) return std::nullopt;
  const std::optional<Vector3> connector = point_at(pixels, camera, *middle);
  if (!connector) return std::nullopt;

  tof::CameraFromTarget pose;
  pose.t = sight / q.dot(sight);
  const Vector3 n_z = -q.normalized();
  const Vector3 n_y = n_z.cross(*connector - pose.t).normalized();
  pose.R << n_y.cross(n_z), n_y, n_z;
  return pose;
}

}  // namespace pharos::tools
