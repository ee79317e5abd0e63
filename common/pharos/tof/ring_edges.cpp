// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_edges.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/tof/image_profile.hpp"

namespace pharos::tof {
namespace {

// A change weaker than this share of the median is noise, or the rim of something else.
constexpr double kLeastStrength = 0.3;
// Edges of less contrast are used only where there are not this many better ones.
constexpr double kGoodContrast = 0.5;
constexpr std::size_t kEnoughPoints = 96;

// Whether two of three depths around a point of the model's plane lie on it.
bool on_plane(const TofFrame& frame, const DepthCamera& camera, const Vector3& point, double gate_m) {
  const auto pixel = project(camera.optics, point);
  if (!pixel) return false;
  const auto u = static_cast<std::int32_t>(std::lround(pixel->x()));
  const auto v = static_cast<std::int32_t>(std::lround(pixel->y()));
  if (u < 1 || v < 0 || u >= frame.depth.width_px - 1 || v >= frame.depth.height_px) return false;
  int good = 0;
  for (std::int32_t step = -1; step <= 1; ++step) {
    const std::uint16_t counts = frame.depth.at(u + step, v);
    good += has_depth(counts) && std::fabs(depth_z_m(camera, counts) - point.z()) < gate_m ? 1 : 0;
  }
  return good >= 2;
}

void drop_weak(RingEdgePoints& points) {
  if (points.empty()) return;
  std::array<double, kMostEdgePoints> strengths{};
  for (std::size_t i = 0; i < points.size(); ++i) strengths[i] = points[i].strength;
  const auto middle = strengths.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(strengths.begin(), middle, strengths.begin() + static_cast<std::ptrdiff_t>(points.size()));
  const double least = kLeastStrength * *middle;
  std::size_t good = 0;
  for (const RingEdgePoint& point : points) good += point.contrast >= kGoodContrast && !point.wall_in_sight ? 1 : 0;
  const double least_contrast = good >= kEnoughPoints ? kGoodContrast : 0.0;
  std::size_t kept = 0;
  for (const RingEdgePoint& point : points) {
    if (point.strength >= least && (point.contrast >= least_contrast || point.wall_in_sight)) points[kept++] = point;
  }
  points.resize(kept);
}

}  // namespace

double find_ring_edges(const TofFrame& frame, const DepthCamera& camera, const RingModel& model, RingEdge edge,
                       bool bright_inside, double search_px, double depth_gate_m, RingEdgePoints& points) {
  points.clear();
  const int search = std::clamp(static_cast<int>(std::ceil(search_px)), 1, kMostSearch_px);
  const PlaneAxes axes = axes_of(model.normal);
  const double radius = model.radius(edge);
  const double middle_radius = 0.5 * (model.radius_m[0] + model.radius_m[1]);
  const double circumference_px = kTwoPi * radius * camera.optics.fx_px / model.centre_m.z();
  if (!(circumference_px > 8.0)) return 0.0;
  const int count = std::min(static_cast<int>(kMostEdgePoints), static_cast<int>(circumference_px));
  // The direction turns by the same angle each time: no sine or cosine in the loop.
  const double cosine_step = std::cos(kTwoPi / count);
  const double sine_step = std::sin(kTwoPi / count);
  Vector2 direction(1.0, 0.0);
  const double sign = bright_inside ? -1.0 : 1.0;
  int seen = 0;
  for (int k = 0; k < count; ++k) {
    const Vector3 radial = direction.x() * axes.first + direction.y() * axes.second;
    const Vector3 along = -direction.y() * axes.first + direction.x() * axes.second;
    const Vector2 here = direction;
    direction = Vector2(cosine_step * direction.x() - sine_step * direction.y(),
                        sine_step * direction.x() + cosine_step * direction.y());
    if (!on_plane(frame, camera, model.centre_m + middle_radius * radial, depth_gate_m)) continue;
    ++seen;
    const Vector3 point = model.centre_m + radius * radial;
    const auto pixel = project(camera.optics, point);
    if (!pixel) continue;
    const Matrix23 slope = project_jacobian(camera.optics, point);
    const Vector2 tangent = slope * along;
    Vector2 normal = Vector2(tangent.y(), -tangent.x()).normalized();
    if (normal.dot(slope * radial) < 0.0) normal = -normal;
    const ProfileEdge found = steepest_on_profile(frame.intensity, *pixel, normal, search, sign);
    // The outer wall looks away from the axis, the inner one towards it; the eye is at the origin.
    const bool wall_in_sight = edge == RingEdge::kOuter ? point.dot(radial) < 0.0 : point.dot(radial) > 0.0;
    if (!(found.strength > 0.0)) continue;
    const double brighter = std::max({1.0, found.before, found.beyond});
    const double contrast = 1.0 - std::min(found.before, found.beyond) / brighter;
    points.push_back({point, normal, found.offset_px, found.strength, contrast, wall_in_sight, here});
  }
  drop_weak(points);
  return static_cast<double>(seen) / count;
}

}  // namespace pharos::tof
