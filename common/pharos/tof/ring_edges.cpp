// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_edges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pharos/base/units.hpp"
#include "pharos/tof/layer_intensity.hpp"

namespace pharos::tof {
namespace {

// A change weaker than this fraction of the median is noise, or another object's rim.
constexpr double kMinStrength = 0.3;
// A pixel darker than this fraction of the ring and without depth is dark background; a brighter one lost its depth.
constexpr double kDarkFraction = 0.3;
// Directions checked for the depth of the surroundings, and the quantile of their depths: walls and connectors are
// nearer, little is farther.
constexpr int kBaseDirections = 64;
constexpr double kBaseQuantile = 0.7;

void drop_weak(RingEdgePoints& points) {
  if (points.empty()) return;
  std::array<double, kMaxEdgePoints> strengths;
  for (std::size_t i = 0; i < points.size(); ++i) strengths[i] = points[i].strength;
  const auto middle = strengths.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(strengths.begin(), middle, strengths.begin() + static_cast<std::ptrdiff_t>(points.size()));
  const double minimum = kMinStrength * *middle;
  std::size_t kept = 0;
  for (const RingEdgePoint& point : points) {
    if (point.strength >= minimum) points[kept++] = point;
  }
  points.resize(kept);
}

class EdgeFinder {
 public:
  EdgeFinder(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
             RingEdge edge, double search_px, const RingPrior& prior)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        model_(model),
        plane_(model.plane()),
        axes_(axes_of(model.normal)),
        edge_(edge),
        search_(std::clamp(static_cast<int>(std::ceil(search_px)), 1, kMaxSearch_px)),
        away_(edge == RingEdge::kOuter ? 1.0 : -1.0),
        prior_(prior) {}

  double find(RingEdgePoints& points) {
    points.clear();
    const double radius = model_.radius(edge_);
    const double middle_radius = 0.5 * (model_.radius_m[0] + model_.radius_m[1]);
    const double circumference_px = kTwoPi * radius * camera_.intrinsics.fx_px / model_.centre_m.z();
    if (!(circumference_px > 8.0)) return 0.0;
    const int count = std::min(static_cast<int>(kMaxEdgePoints), static_cast<int>(circumference_px));
    base_m_ = typical_base();
    // The direction rotates by the same angle each time: no sine or cosine in the loop.
    const double cosine_step = std::cos(kTwoPi / count);
    const double sine_step = std::sin(kTwoPi / count);
    Vector2 direction(1.0, 0.0);
    int seen = 0;
    for (int k = 0; k < count; ++k) {
      if (on_plane(frame_, camera_, model_.centre_m + middle_radius * radial(direction), prior_.depth_gate_m)) {
        ++seen;
        if (const auto point = point_in(direction)) points.push_back(*point);
      }
      direction = Vector2(cosine_step * direction.x() - sine_step * direction.y(),
                          sine_step * direction.x() + cosine_step * direction.y());
    }
    drop_weak(points);
    return static_cast<double>(seen) / count;
  }

 private:
  Vector3 radial(const Vector2& direction) const { return direction.x() * axes_.first + direction.y() * axes_.second; }

  // Depth of the surroundings beyond this edge where its wall does not cover them; negative, 0 where not seen.
  double typical_base() const {
    std::array<double, kBaseDirections> depths{};
    std::size_t count = 0;
    for (int k = 0; k < kBaseDirections; ++k) {
      const double angle = kTwoPi * k / kBaseDirections;
      const auto across = profile_in({std::cos(angle), std::sin(angle)});
      if (!across) continue;
      const double base = base_of(across->light);
      if (base < -prior_.min_step_m) depths[count++] = -base;
    }
    if (count == 0) return 0.0;
    const auto place = depths.begin() + static_cast<std::ptrdiff_t>(kBaseQuantile * static_cast<double>(count - 1));
    std::nth_element(depths.begin(), place, depths.begin() + static_cast<std::ptrdiff_t>(count));
    return -*place;
  }

  struct Across {
    Vector3 point_m;
    Vector2 normal_px;  // away from the ring's middle
    LightProfile light;
  };

  std::optional<Across> profile_in(const Vector2& direction) const {
    const Vector3 outwards = radial(direction);
    Across across;
    across.point_m = model_.centre_m + model_.radius(edge_) * outwards;
    const auto pixel = project(camera_.intrinsics, across.point_m);
    if (!pixel) return std::nullopt;
    const Matrix23 slope = project_jacobian(camera_.intrinsics, across.point_m);
    const Vector2 tangent = slope * (-direction.y() * axes_.first + direction.x() * axes_.second);
    across.normal_px = Vector2(tangent.y(), -tangent.x()).normalized();
    if (across.normal_px.dot(slope * outwards) < 0.0) across.normal_px = -across.normal_px;
    if (!sample_light(frame_, camera_, rays_, plane_, *pixel, across.normal_px, search_,
                      kDarkFraction * prior_.amplitude, across.light)) {
      return std::nullopt;
    }
    return across;
  }

  // Height of the farthest pixel beyond the edge; 0 where that is dark.
  double base_of(const LightProfile& light) const {
    const std::size_t last = 2U * static_cast<std::size_t>(search_ + kProfileReach_px);
    double amplitude = 0.0;
    double moment = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = edge_ == RingEdge::kOuter ? last - i : i;
      amplitude += light.amplitude[k];
      moment += light.moment[k];
    }
    return amplitude > 0.0 ? moment / amplitude : 0.0;
  }

  std::optional<RingEdgePoint> point_in(const Vector2& direction) const {
    const auto across = profile_in(direction);
    if (!across) return std::nullopt;
    const Vector3& point = across->point_m;
    const Vector3 outwards = radial(direction);
    // The outer wall faces away from the axis, the inner one towards it; the camera is at the origin.
    const double wall_cosine = -away_ * point.dot(outwards) / point.norm();
    const double wall_fraction = wall_cosine / (-point.dot(model_.normal) / point.norm());
    if (wall_fraction > kBrightWall) return std::nullopt;
    double base = base_of(across->light);
    // Where the wall covers the profile's end, the depth from the other directions.
    if (wall_fraction > 0.0 || base == 0.0) base = std::min(base, base_m_);
    if (!(base < -prior_.min_step_m)) return std::nullopt;
    const ProfileEdge found = steepest_of_samples(light_of_layer(across->light, search_, 0.0, base), search_, -away_);
    if (!(found.strength > 0.0)) return std::nullopt;
    const Vector2 wall_px = project_jacobian(camera_.intrinsics, point) * (base * model_.normal);
    const double shift = away_ * wall_shift_px(wall_fraction, std::fabs(wall_px.dot(across->normal_px)));
    return RingEdgePoint{point, across->normal_px, found.offset_px - shift, found.strength, shift, direction};
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& model_;
  DepthPlane plane_;
  PlaneAxes axes_;
  RingEdge edge_;
  int search_;
  double away_;
  const RingPrior& prior_;
  double base_m_ = 0.0;
};

}  // namespace

bool on_plane(const TofFrame& frame, const DepthCamera& camera, const Vector3& point, double gate_m) {
  const auto pixel = project(camera.intrinsics, point);
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

Vector7 edge_row(const DepthCamera& camera, const RingModel& model, const PlaneAxes& axes, const Vector3& point_m,
                 const Vector2& normal_px, RingEdge edge) {
  const Vector3 by_point = project_jacobian(camera.intrinsics, point_m).transpose() * normal_px;
  const Vector3 arm = point_m - model.centre_m;
  Vector7 row = Vector7::Zero();
  row[0] = by_point.dot(axes.first.cross(arm));
  row[1] = by_point.dot(axes.second.cross(arm));
  row.segment<3>(2) = by_point;
  row[5 + static_cast<int>(edge)] = by_point.dot(arm) / model.radius(edge);
  return row;
}

double find_ring_edges(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                       RingEdge edge, double search_px, const RingPrior& prior, RingEdgePoints& points) {
  return EdgeFinder(frame, camera, rays, model, edge, search_px, prior).find(points);
}

}  // namespace pharos::tof
