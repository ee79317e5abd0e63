// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_extent.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::tof {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// The band beside the edge: past the mixed pixels, and still within narrow rings.
constexpr double kBandNear_px = 1.25;
constexpr double kBandFar_px = 4.5;
constexpr double kMinExtentInliers = 0.35;
constexpr double kScanStep_px = 0.5;
// Anything narrower is not a ring.
constexpr double kMinExtent_px = 2.5;
constexpr int kDirections = 72;

RingRegion band_beside(const ellipse::Ellipse& shape, RingEdge known) {
  if (known == RingEdge::kInner) return {EllipseRows(shape, kBandNear_px), EllipseRows(shape, kBandFar_px)};
  return {EllipseRows(shape, -kBandFar_px), EllipseRows(shape, -kBandNear_px)};
}

// Directions in which depths lie on the plane at a radius.
class PlaneScan {
 public:
  PlaneScan(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
            double gate_m)
      : frame_(frame), camera_(camera), rays_(rays), model_(model), plane_(model.plane()), gate_m_(gate_m) {
    const PlaneAxes axes = axes_of(model.normal);
    for (int k = 0; k < kDirections; ++k) {
      const double angle = kTwoPi * k / kDirections;
      radial_[static_cast<std::size_t>(k)] = std::cos(angle) * axes.first + std::sin(angle) * axes.second;
    }
  }

  bool on_plane(std::size_t direction, double radius_m) const {
    const auto pixel = project(camera_.intrinsics, model_.centre_m + radius_m * radial_[direction]);
    if (!pixel) return false;
    const auto u = static_cast<std::int32_t>(std::lround(pixel->x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel->y()));
    if (!frame_.depth.contains(u, v) || !has_depth(frame_.depth.at(u, v))) return false;
    return std::fabs(plane_.height_m(rays_.at(u, v), depth_z_m(camera_, frame_.depth.at(u, v)))) < gate_m_;
  }

 private:
  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingModel& model_;
  DepthPlane plane_;
  double gate_m_;
  std::array<Vector3, kDirections> radial_;
};

// Where the plane ends in most of the directions in which it begins; 0 where it does not.
double end_of_plane(const PlaneScan& scan, double start_m, double step_m, double limit_m, double min_width_m) {
  std::array<bool, kDirections> begins{};
  int beginning = 0;
  for (std::size_t k = 0; k < kDirections; ++k) {
    begins[k] = scan.on_plane(k, start_m);
    beginning += begins[k] ? 1 : 0;
  }
  if (beginning < kDirections / 3) return 0.0;
  const int steps = static_cast<int>(std::fabs((limit_m - start_m) / step_m));
  for (int i = 1; i <= steps; ++i) {
    const double radius = start_m + i * step_m;
    int left = 0;
    for (std::size_t k = 0; k < kDirections; ++k) left += begins[k] && scan.on_plane(k, radius) ? 1 : 0;
    if (2 * left >= beginning) continue;
    return std::fabs(radius - start_m) >= min_width_m ? radius : 0.0;
  }
  return 0.0;
}

}  // namespace

std::optional<RingModel> ring_from_one_edge(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                            const ellipse::Ellipse& shape, RingEdge known, double min_ratio) {
  const auto plane = fit_plane(frame, camera, rays, band_beside(shape, known));
  if (!plane || plane->inlier_fraction < kMinExtentInliers) return std::nullopt;
  auto model = ring_on_plane(plane->plane, rays, shape, shape);
  if (!model) return std::nullopt;
  const double radius = model->radius(known);
  const double metres_per_px = model->centre_m.z() / camera.intrinsics.fx_px;
  const PlaneScan scan(frame, camera, rays, *model, 3.0 * plane->rms_m + 0.004);
  const double outwards = known == RingEdge::kInner ? 1.0 : -1.0;
  const double limit = known == RingEdge::kInner ? radius / min_ratio : radius * min_ratio;
  const double start = radius + outwards * 0.5 * (kBandNear_px + kBandFar_px) * metres_per_px;
  const double other = end_of_plane(scan, start, outwards * kScanStep_px * metres_per_px, limit, 0.0);
  if (other == 0.0 || std::fabs(other - radius) < kMinExtent_px * metres_per_px) return std::nullopt;
  model->radius_m[index_of(known == RingEdge::kInner ? RingEdge::kOuter : RingEdge::kInner)] = other;
  return model;
}

std::optional<RingModel> ring_from_plane_extent(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                                const RingModel& model, double gate_m) {
  const PlaneScan scan(frame, camera, rays, model, gate_m);
  const double middle = 0.5 * (model.radius_m[0] + model.radius_m[1]);
  const double step = kScanStep_px * model.centre_m.z() / camera.intrinsics.fx_px;
  RingModel result = model;
  result.radius_m = {end_of_plane(scan, middle, step, 2.0 * middle, 0.0),
                     end_of_plane(scan, middle, -step, 0.5 * middle, 0.0)};
  if (result.radius_m[0] == 0.0 || result.radius_m[1] == 0.0) return std::nullopt;
  return result;
}

std::optional<ellipse::Ellipse> image_of(const RingModel& model, RingEdge edge, const PinholeCamera& camera) {
  constexpr int kPoints = 24;
  std::array<Vector2, kPoints> contour;
  const PlaneAxes axes = axes_of(model.normal);
  Vector2 mean = Vector2::Zero();
  for (int k = 0; k < kPoints; ++k) {
    const double angle = kTwoPi * k / kPoints;
    const auto pixel = project(
        camera, model.centre_m + model.radius(edge) * (std::cos(angle) * axes.first + std::sin(angle) * axes.second));
    if (!pixel) return std::nullopt;
    contour[static_cast<std::size_t>(k)] = *pixel;
    mean += *pixel / kPoints;
  }
  // A x^2 + B x y + C y^2 + D x + E y = 1 in units of the contour's own size about its mean.
  const double unit = (contour[0] - mean).norm();
  if (!(unit > 0.0)) return std::nullopt;
  Matrix5 normal = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  for (const Vector2& point : contour) {
    const Vector2 p = (point - mean) / unit;
    Vector5 row;
    row << p.x() * p.x(), p.x() * p.y(), p.y() * p.y(), p.x(), p.y();
    add_outer<5>(normal, row, 1.0);
    right += row;
  }
  const auto inverse = positive_inverse<5>(normal);
  if (!inverse) return std::nullopt;
  const Vector5 conic = *inverse * right;
  Matrix2 form;
  form << conic[0], 0.5 * conic[1], 0.5 * conic[1], conic[2];
  if (!conic.allFinite() || !(form.determinant() > 0.0) || !(form.trace() > 0.0)) return std::nullopt;
  const Vector2 centre = -0.5 * form.inverse() * conic.tail<2>();
  const double scale = 1.0 + centre.dot(form * centre);
  const double middle = 0.5 * form.trace();
  const double spread = std::hypot(0.5 * (form(0, 0) - form(1, 1)), form(0, 1));
  if (!(middle - spread > 0.0)) return std::nullopt;
  // The axis of the smaller eigenvalue is the longer one.
  const double theta = 0.5 * std::atan2(-2.0 * form(0, 1), form(1, 1) - form(0, 0));
  return ellipse::normalised({mean.x() + unit * centre.x(), mean.y() + unit * centre.y(),
                              unit * std::sqrt(scale / (middle - spread)), unit * std::sqrt(scale / (middle + spread)),
                              theta});
}

}  // namespace pharos::tof
