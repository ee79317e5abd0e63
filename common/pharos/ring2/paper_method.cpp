// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/paper_method.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/ring2/cone.hpp"

namespace pharos::ring2 {
namespace {

// A circle as one camera measures it: 2.2.1 gives its centre for each unit of radius.
struct SeenCircle {
  std::array<CirclePose, 2> poses;
  double size_px = 0.0;  // R1 or r1 of (4), (5): the semi-major axis
};

// The image of the circle's centre and its size, in the camera's frame.
struct CentreImage {
  double x = 0.0, y = 0.0;  // of the ray, over the focal length
  double size_px = 0.0;
};

double focal_px(const RigView& view) { return 0.5 * (view.intrinsics.fx_px + view.intrinsics.fy_px); }

std::optional<SeenCircle> seen_circle(const RigView& view, const Contour& contour) {
  const std::optional<Cone> cone = cone_of(contour.ellipse, view);
  if (!cone) return std::nullopt;
  const auto poses = circle_poses(*cone);
  if (!poses) return std::nullopt;
  return SeenCircle{*poses, contour.ellipse.a_px};
}

struct SharedCircle {
  double radius_m = 0.0;
  std::array<Vector3, kViews> centre_per_radius;
  Vector3 centre_m = Vector3::Zero();
};

// 2.2.1: both cameras must find one centre; least squares for the radius. Of the four pairs of the cones' circles, the
// one whose centres come nearest to each other and whose planes are most parallel.
std::optional<SharedCircle> shared_circle(const Rig& rig, const std::array<SeenCircle, kViews>& seen) {
  const Vector3 baseline = rig.views[1].T_rig_camera.t - rig.views[0].T_rig_camera.t;
  std::optional<SharedCircle> best;
  double minimum = 0.0;
  for (const CirclePose& left : seen[0].poses) {
    for (const CirclePose& right : seen[1].poses) {
      const Vector3 difference = left.centre_per_radius - right.centre_per_radius;
      const double radius_m = baseline.dot(difference) / difference.squaredNorm();
      if (!(radius_m > 0.0)) continue;
      const double apart =
          (radius_m * difference - baseline).norm() / baseline.norm() + (left.normal - right.normal).norm();
      if (best && apart >= minimum) continue;
      minimum = apart;
      const Vector3 middle = 0.5 * (rig.views[0].T_rig_camera.t + rig.views[1].T_rig_camera.t);
      best = SharedCircle{radius_m,
                          {left.centre_per_radius, right.centre_per_radius},
                          middle + 0.5 * radius_m * (left.centre_per_radius + right.centre_per_radius)};
    }
  }
  return best;
}

CentreImage image_of(const RigView& view, const Vector3& ray_rig, double size_px) {
  const Vector3 ray = view.T_rig_camera.R.transpose() * ray_rig;
  return {ray.x() / ray.z(), ray.y() / ray.z(), size_px};
}

// (1)-(5) in the planes XZ and YZ of the camera.
std::array<PlaneTriangle, 2> apparent_circles(const RigView& view, const CentreImage& ring, const CentreImage& nozzle,
                                              double ring_radius_m, double nozzle_radius_m) {
  const double CD_m = focal_px(view) * ring_radius_m / ring.size_px;
  const double CE_m = focal_px(view) * nozzle_radius_m / nozzle.size_px;
  return {PlaneTriangle{std::atan(ring.x), std::atan(nozzle.x), CD_m, CE_m},
          PlaneTriangle{std::atan(ring.y), std::atan(nozzle.y), CD_m, CE_m}};
}

// Angles of the camera's own axis in the rig's planes XZ and YZ: the toe-in that (19) assumes equal on both sides.
std::array<double, 2> mounting_of(const RigView& view) {
  const Vector3 forward = view.T_rig_camera.R.col(2);
  return {std::atan2(forward.x(), forward.z()), std::atan2(forward.y(), forward.z())};
}

using Circles = std::array<SharedCircle, kFeatures>;

std::optional<Ring2Failure> rig_refusal(const Rig& rig) {
  switch (fault_of(rig)) {
    case RigFault::kNone:
      break;
    case RigFault::kIntrinsics:
      return Ring2Failure::kRigIntrinsics;
    case RigFault::kRotation:
      return Ring2Failure::kRigRotation;
    case RigFault::kCamerasCoincide:
      return Ring2Failure::kCamerasCoincide;
  }
  return std::nullopt;
}

// Ring and nozzle by both cameras.
Result<Circles, Ring2Failure> circles_of(const Rig& rig, const ContourSet& contours) {
  if (const auto refusal = rig_refusal(rig)) return *refusal;
  for (const auto& view : contours) {
    for (const auto& contour : view) {
      if (!contour) return Ring2Failure::kTooFewEllipses;
      if (!is_usable(contour->ellipse)) return Ring2Failure::kBadEllipse;
    }
  }
  Circles circles;
  for (std::size_t f = 0; f < kFeatures; ++f) {
    const auto left = seen_circle(rig.views[0], *contours[0][f]);
    const auto right = seen_circle(rig.views[1], *contours[1][f]);
    if (!left || !right) return Ring2Failure::kBadEllipse;
    const auto shared = shared_circle(rig, {*left, *right});
    if (!shared) return Ring2Failure::kInconsistent;
    circles[f] = *shared;
  }
  return circles;
}

std::array<PlaneTriangle, 2> triangles_of(const RigView& view, std::size_t v, const ContourSet& contours,
                                          const Circles& circles) {
  const CentreImage ring = image_of(view, circles[0].centre_per_radius[v], contours[v][0]->ellipse.a_px);
  const CentreImage nozzle = image_of(view, circles[1].centre_per_radius[v], contours[v][1]->ellipse.a_px);
  return apparent_circles(view, ring, nozzle, circles[0].radius_m, circles[1].radius_m);
}

// From the axis' angles in the rig's planes: n = (-sin gamma, .., ..), so XZ counts against gamma.
Attitude attitude_of_planes(double xz_rad, double yz_rad) { return {yz_rad, -xz_rad}; }

}  // namespace

double distance_by_paper(const PlaneTriangle& s) {
  // (6), (7), signed. (8) and (9) measure A and B from O1, where A B meets the optical axis: d = O1B - O1A. They divide
  // by BE - AD, which is zero where the target's axis is parallel to the camera's; signed, they say:
  const double AD_m = s.CD_m * std::tan(s.beta1_rad);
  const double BE_m = s.CE_m * std::tan(s.beta2_rad);
  return std::hypot(s.CD_m - s.CE_m, BE_m - AD_m);
}

double axis_angle_by_paper(const PlaneTriangle& s, double distance_m) {
  // (10), (13), (16) and (12), (15), (18) are one formula with signed beta; its signs are the three cases by where the
  // principal point lies.
  const double AC_m = s.CD_m / std::cos(s.beta1_rad);
  const double sine = AC_m / distance_m * std::sin(s.beta2_rad - s.beta1_rad);
  return std::asin(std::clamp(sine, -1.0, 1.0)) - s.beta2_rad;
}

Result<PaperAttitudes, Ring2Failure> paper_attitudes(const Rig& rig, const ContourSet& contours) {
  const Result<Circles, Ring2Failure> circles = circles_of(rig, contours);
  if (!circles) return circles.error();
  PaperAttitudes attitudes;
  for (std::size_t v = 0; v < kViews; ++v) {
    const std::array<PlaneTriangle, 2> planes = triangles_of(rig.views[v], v, contours, *circles);
    const std::array<double, 2> mounting = mounting_of(rig.views[v]);
    std::array<double, 2> angle_rad{};
    for (std::size_t k = 0; k < planes.size(); ++k) {
      angle_rad[k] = axis_angle_by_paper(planes[k], distance_by_paper(planes[k])) - mounting[k];
    }
    attitudes.camera[v] = attitude_of_planes(angle_rad[0], angle_rad[1]);
    attitudes.distance_m += 0.5 * distance_by_paper(planes[0]);
  }
  // (19) and (24) as signed means; (24) as printed is a difference that symmetry makes zero.
  attitudes.both = {0.5 * (attitudes.camera[0].theta_rad + attitudes.camera[1].theta_rad),
                    0.5 * (attitudes.camera[0].gamma_rad + attitudes.camera[1].gamma_rad)};
  return attitudes;
}

Result<Ring2Estimate, Ring2Failure> solve_ring2_by_paper(const Rig& rig, const ContourSet& contours) {
  const Result<Circles, Ring2Failure> circles = circles_of(rig, contours);
  if (!circles) return circles.error();
  const Result<PaperAttitudes, Ring2Failure> attitudes = paper_attitudes(rig, contours);
  if (!attitudes) return attitudes.error();
  Ring2Estimate estimate;
  estimate.normal = normal_of(attitudes->both);
  estimate.tilt_axes = tilt_axes(estimate.normal);
  estimate.ring_radius_m = (*circles)[0].radius_m;
  estimate.nozzle_radius_m = (*circles)[1].radius_m;
  estimate.ring_centre_m = (*circles)[0].centre_m;
  estimate.nozzle_centre_m = (*circles)[1].centre_m;
  estimate.distance_m = attitudes->distance_m;
  estimate.ellipses = static_cast<int>(kViews * kFeatures);
  return estimate;
}

Result<Attitude, Ring2Failure> attitude_by_one_camera(const RigView& view, const Contour& ring, const Contour& nozzle,
                                                      const KnownSizes& sizes) {
  std::array<CentreImage, kFeatures> images;
  for (std::size_t f = 0; f < kFeatures; ++f) {
    const ellipse::Ellipse& e = f == 0 ? ring.ellipse : nozzle.ellipse;
    const Result<Vector2, CameraFailure> ray = undistort(view.intrinsics, {e.cx_px, e.cy_px});
    if (!is_usable(e) || !ray) return Ring2Failure::kBadEllipse;
    images[f] = {ray->x(), ray->y(), e.a_px};
  }
  const auto [xz, yz] = apparent_circles(view, images[0], images[1], sizes.ring_radius_m, sizes.nozzle_radius_m);
  const std::array<double, 2> mounting = mounting_of(view);
  return attitude_of_planes(axis_angle_by_paper(xz, sizes.distance_m) - mounting[0],
                            axis_angle_by_paper(yz, sizes.distance_m) - mounting[1]);
}

}  // namespace pharos::ring2
