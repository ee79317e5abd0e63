// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/rim.hpp"

#include <cmath>
#include <optional>

#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

using ring2::Contour;
using ring2::Feature;
using ring2::Ring2Estimate;

// Fractions of a rim's radius: maximum width of its face, and the standard deviation if nothing else is known. Docking
// rings have 4 to 13 %, the stiffening rims of nozzles up to 15 %.
constexpr double kMaxWidth = 0.2;
constexpr double kWidthSigma = 0.1;
// Circles nearer than this fraction are one edge that was found twice.
constexpr double kMinWidth = 0.015;
// Largest deviation of an ellipse of the rim from a concentric circle in the rim's plane.
constexpr double kMaxOff_px = 0.7;
constexpr int kPlaces = 16;
constexpr double kStep = 1e-6;  // step of the numeric derivative, rad and m

struct Plane {
  Vector3 normal, centre_m;
};

Plane plane_of(const Ring2Estimate& estimate, Feature feature, const ring2::Vector8& step) {
  const Vector3 tilt = step[0] * estimate.tilt_axes[0] + step[1] * estimate.tilt_axes[1];
  const Vector3 normal = (estimate.normal + tilt.cross(estimate.normal)).normalized();
  const Vector3 centre = estimate.ring_centre_m + step.segment<3>(ring2::kCentre);
  if (feature == Feature::kRing) return {normal, centre};
  return {normal, centre + (estimate.distance_m + step[ring2::kDistance]) * normal};
}

// A contour projected to a plane: mean distance from the centre and the scatter about it.
struct InPlane {
  double radius_m = 0.0;
  double scatter_m = 0.0;
  double depth_m = 0.0;
};

std::optional<InPlane> in_plane(const ring2::RigView& view, const Contour& contour, const Plane& plane) {
  const Vector3& from = view.T_rig_camera.t;
  InPlane result;
  double square = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const ellipse::PointPx point = ellipse::point_at(contour.ellipse, kTwoPi * k / kPlaces);
    const auto ray = undistort(view.intrinsics, {point.u, point.v});
    if (!ray) return std::nullopt;
    const Vector3 direction = view.T_rig_camera.R * Vector3(ray->x(), ray->y(), 1.0);
    const double depth = plane.normal.dot(plane.centre_m - from) / plane.normal.dot(direction);
    if (!(depth > 0.0)) return std::nullopt;
    const double radius = (from + depth * direction - plane.centre_m).norm();
    result.radius_m += radius / kPlaces;
    result.depth_m += depth / kPlaces;
    square += radius * radius / kPlaces;
  }
  result.scatter_m = std::sqrt(std::max(0.0, square - result.radius_m * result.radius_m));
  return result;
}

// Variance of a contour's common radial displacement, px^2.
double growth_variance(const Contour& contour) {
  const double c = std::cos(contour.ellipse.theta_rad), s = std::sin(contour.ellipse.theta_rad);
  const double a = 2.0 * contour.ellipse.a_px, b = 2.0 * contour.ellipse.b_px;
  const ring2::Vector5 growth(0.0, 0.0, a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c);
  return 1.0 / growth.dot(contour.information * growth);
}

struct WiderEdge {
  std::size_t view = 0;
  const Contour* contour = nullptr;
  InPlane seen;
};

// A rim's edges other than the one in the estimate.
struct OtherEdges {
  bool narrower = false;
  std::optional<WiderEdge> wider;
};

OtherEdges other_edges(const ring2::Rig& rig, const std::array<std::vector<Contour>, ring2::kViews>& contours,
                       const Plane& plane, double radius_m) {
  OtherEdges edges;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    for (const Contour& contour : contours[v]) {
      const std::optional<InPlane> seen = in_plane(rig.views[v], contour, plane);
      if (!seen || seen->scatter_m * rig.views[v].intrinsics.fx_px > kMaxOff_px * seen->depth_m) continue;
      const double wider_by = seen->radius_m / radius_m - 1.0;
      if (std::abs(wider_by) < kMinWidth || std::abs(wider_by) > kMaxWidth) continue;
      edges.narrower = edges.narrower || wider_by < 0.0;
      const double widest = edges.wider ? edges.wider->seen.radius_m : radius_m;
      if (seen->radius_m > widest) edges.wider = {v, &contour, *seen};
    }
  }
  return edges;
}

// Replaces the radius by that of the wider edge. Its variance has three parts: plane and centre, the contour's noise,
// and the contour's deviation from a circle: edge points of shadow or body distort its size as much as its shape.
void take(const ring2::Rig& rig, Feature feature, int unknown, const WiderEdge& edge, Ring2Estimate& estimate) {
  const ring2::RigView& view = rig.views[edge.view];
  ring2::Vector8 slope = ring2::Vector8::Zero();
  for (int i = 0; i < ring2::kUnknowns; ++i) {
    const ring2::Vector8 step = kStep * ring2::Vector8::Unit(i);
    const auto more = in_plane(view, *edge.contour, plane_of(estimate, feature, step));
    const auto less = in_plane(view, *edge.contour, plane_of(estimate, feature, -step));
    if (!more || !less) return;
    slope[i] = (more->radius_m - less->radius_m) / (2.0 * kStep);
  }
  const double per_px = edge.seen.depth_m / view.intrinsics.fx_px;
  const ring2::Vector8 shared = estimate.covariance * slope;
  const double variance =
      slope.dot(shared) + per_px * per_px * growth_variance(*edge.contour) + edge.seen.scatter_m * edge.seen.scatter_m;
  estimate.covariance.row(unknown) = shared.transpose();
  estimate.covariance.col(unknown) = shared;
  estimate.covariance(unknown, unknown) = variance;
  (feature == Feature::kRing ? estimate.ring_radius_m : estimate.nozzle_radius_m) = edge.seen.radius_m;
}

}  // namespace

std::uint8_t settle_rims(const ring2::Rig& rig, const std::array<std::vector<Contour>, ring2::kViews>& contours,
                         Ring2Estimate& estimate) {
  std::uint8_t one_edge = 0;
  for (const Feature feature : {Feature::kRing, Feature::kNozzle}) {
    const bool ring = feature == Feature::kRing;
    const std::uint8_t unobservable =
        ring2::kUnobservableScale | (ring ? ring2::kUnobservableRing : ring2::kUnobservableNozzle);
    if ((estimate.unobservable & unobservable) != 0) continue;
    const int unknown = ring ? ring2::kRadius : ring2::kSecondRadius;
    const double radius_m = ring ? estimate.ring_radius_m : estimate.nozzle_radius_m;
    const Plane plane = plane_of(estimate, feature, ring2::Vector8::Zero());
    const OtherEdges others = other_edges(rig, contours, plane, radius_m);
    if (others.wider) {
      take(rig, feature, unknown, *others.wider, estimate);
    } else if (!others.narrower) {
      one_edge |= ring ? kOneEdgeRing : kOneEdgeNozzle;
      estimate.covariance(unknown, unknown) += kWidthSigma * kWidthSigma * radius_m * radius_m;
    }
  }
  return one_edge;
}

}  // namespace pharos::host
