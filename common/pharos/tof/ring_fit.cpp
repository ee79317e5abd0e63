// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_fit.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/sector_sums.hpp"

namespace pharos::tof {
namespace {

// The ellipses' own edges are at most a pixel off; after the first round half of that is left. Where all pixels have
// the last word, two rounds are a good start for them.
constexpr std::array<double, 2> kSearch_px = {3.0, 2.0};
constexpr double kLastSearch_px = 2.0;
// Error of what blur does to the plane, over itself: it comes from the tails of the blur, of which the edges show only
// the width.
constexpr double kBiasSigma = 1.0;
constexpr int kSteps = 3;  // of reweighting in each round
constexpr double kGate = 3.0;
constexpr double kMinEdgeSigma_px = 0.02;
constexpr std::size_t kMinEdgePoints = 24;
// Relative uncertainty of the wall's effect on an edge: its light need not go with the cosine.
constexpr double kWallSigma = 0.3;
// Chi-squared of three degrees of freedom that chance exceeds once in twenty. Where edges and depths give planes
// further apart than that, one of them errs beyond its noise: the covariance is scaled by the disagreement (Birge's
// ratio).
constexpr double kDoubtful = 7.8;
// Deviation common to all edges; what the simulated classes show beyond the residuals.
constexpr double kCommonEdge_px = 0.012;

// d q / d unknowns of the plane that a model lies in: q = n / (n . c).
Matrix37 plane_jacobian(const RingModel& model, const PlaneAxes& axes) {
  const double distance = model.normal.dot(model.centre_m);
  Matrix37 jacobian = Matrix37::Zero();
  const std::array<Vector3, 2> turned = {axes.first.cross(model.normal), axes.second.cross(model.normal)};
  for (int k = 0; k < 2; ++k) {
    const Vector3& dn = turned[static_cast<std::size_t>(k)];
    jacobian.col(k) = dn / distance - model.normal * (dn.dot(model.centre_m) / (distance * distance));
  }
  for (int k = 0; k < 3; ++k) jacobian.col(2 + k) = -model.normal * (model.normal[k] / (distance * distance));
  return jacobian;
}

RingModel moved(const RingModel& model, const PlaneAxes& axes, const Vector7& by) {
  RingModel result = model;
  result.normal = (rotation_exp(by[0] * axes.first + by[1] * axes.second) * model.normal).normalized();
  result.centre_m += by.segment<3>(2);
  result.radius_m[0] += by[5];
  result.radius_m[1] += by[6];
  return result;
}

// Robust deviation of the residuals.
double deviation(const RingEdgePoints& points, const std::array<double, kMaxEdgePoints>& residuals) {
  std::array<double, kMaxEdgePoints> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) sizes[i] = std::fabs(residuals[i]);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(points.size()));
  return std::max(kMinEdgeSigma_px, kMedianToSigma * *middle);
}

// One circle's part of the normal equations, linear in the unknowns about the model.
struct EdgeSums {
  Matrix7 normal = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
  SectorSums residuals;
  // The error of the walls' effect, common to all points.
  Vector7 with_wall = Vector7::Zero();
  double wall = 0.0;
  double wall_right = 0.0;

  void add(const Vector7& row, const RingEdgePoint& point, double weight) {
    add_outer<7>(normal, row, weight);
    right += (weight * point.offset_px) * row;
    with_wall += (weight * point.wall_shift_px) * row;
    wall += weight * point.wall_shift_px * point.wall_shift_px;
    wall_right += weight * point.wall_shift_px * point.offset_px;
  }
};

void take_rows(const DepthCamera& camera, const RingModel& model, const PlaneAxes& axes, RingEdge edge,
               RingFitWorkspace& workspace) {
  const RingEdgePoints& points = workspace.points[index_of(edge)];
  auto& rows = workspace.rows[index_of(edge)];
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows[i] = edge_row(camera, model, axes, points[i].point_m, points[i].normal_px, edge);
  }
}

EdgeSums edge_sums(const RingEdgePoints& points, const RingEdgeRows& rows, const Vector7& step) {
  EdgeSums sums;
  if (points.size() < kMinEdgePoints) return sums;
  std::array<double, kMaxEdgePoints> residuals;
  for (std::size_t i = 0; i < points.size(); ++i) residuals[i] = points[i].offset_px - rows[i].dot(step);
  const double gate = kGate * deviation(points, residuals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::fabs(residuals[i]) < gate)) continue;
    sums.residuals.add(points[i].direction.x(), points[i].direction.y(), 1.0, residuals[i]);
  }
  const double variance =
      std::max(kMinEdgeSigma_px * kMinEdgeSigma_px, sums.residuals.variance()) * sums.residuals.variance_inflation(4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::fabs(residuals[i]) < gate) sums.add(rows[i], points[i], 1.0 / variance);
  }
  return sums;
}

struct Solved {
  Vector7 step = Vector7::Zero();
  Matrix7 covariance = Matrix7::Zero();
  double edge_squares = 0.0;
  std::int32_t edge_points = 0;
  double plane_chi2 = 0.0;
};

// Both circles' edges and the depths' plane, reweighted by their residuals.
std::optional<Solved> solve_round(const DepthCamera& camera, const RingModel& model, const PlaneFit& plane,
                                  RingFitWorkspace& workspace) {
  const PlaneAxes axes = axes_of(model.normal);
  for (const RingEdge edge : kRingEdges) take_rows(camera, model, axes, edge, workspace);
  const Matrix37 by_plane = plane_jacobian(model, axes);
  const Vector3 plane_offset = plane.plane.q - model.plane().q;
  Solved solved;
  for (int k = 0; k < kSteps; ++k) {
    Matrix7 normal = by_plane.transpose() * plane.information * by_plane;
    Vector7 right = by_plane.transpose() * (plane.information * plane_offset);
    solved.edge_squares = 0.0;
    solved.edge_points = 0;
    EdgeSums both;
    for (const RingEdge edge : kRingEdges) {
      const EdgeSums sums = edge_sums(workspace.points[index_of(edge)], workspace.rows[index_of(edge)], solved.step);
      normal += sums.normal;
      right += sums.right;
      both.with_wall += sums.with_wall;
      both.wall += sums.wall;
      both.wall_right += sums.wall_right;
      solved.edge_squares += sums.residuals.variance() * sums.residuals.count();
      solved.edge_points += sums.residuals.count();
    }
    if (solved.edge_points < static_cast<std::int32_t>(kMinEdgePoints)) return std::nullopt;
    // The walls' error is one more unknown, with a prior near zero; eliminated.
    const double wall = both.wall + 1.0 / (kWallSigma * kWallSigma);
    add_outer<7>(normal, both.with_wall, -1.0 / wall);
    right -= (both.wall_right / wall) * both.with_wall;
    const auto covariance = positive_inverse<7>(normal);
    if (!covariance) return std::nullopt;
    solved.covariance = *covariance;
    solved.step = solved.covariance * right;
    if (!solved.step.allFinite()) return std::nullopt;
  }
  const Vector3 left = plane_offset - by_plane * solved.step;
  solved.plane_chi2 = left.dot(plane.information * left);
  if (solved.plane_chi2 > kDoubtful) solved.covariance *= solved.plane_chi2 / 3.0;
  return solved;
}

// Effect of a common error of all depths: the plane moves along z, the centre and the radii along their rays.
Matrix7 common_noise(const RingModel& model, double sigma_m) {
  Vector7 moves = Vector7::Zero();
  moves.segment<3>(2) = model.centre_m / model.centre_m.z();
  moves[5] = model.radius_m[0] / model.centre_m.z();
  moves[6] = model.radius_m[1] / model.centre_m.z();
  return sigma_m * sigma_m * moves * moves.transpose();
}

// Foil of uneven depth beside an edge and walls shift it along whole sides of the ring: an error common to both
// circles.
Matrix7 common_place(const DepthCamera& camera, const RingModel& model) {
  const double sigma_m = kCommonEdge_px * model.centre_m.z() / camera.intrinsics.fx_px;
  Matrix7 covariance = Matrix7::Zero();
  covariance(2, 2) = covariance(3, 3) = sigma_m * sigma_m;
  return covariance;
}

bool is_sane(const RingModel& model) {
  return model.centre_m.allFinite() && model.normal.allFinite() && model.centre_m.z() > 0.0 &&
         model.radius_m[1] > 0.0 && model.radius_m[1] < model.radius_m[0] && model.normal.dot(model.centre_m) < 0.0;
}

// By what the light from behind does to it (RingLight::plane_bias): how q changes once that is subtracted.
Matrix3 q_by_bias(const DepthPlane& plane, const RingModel& model) {
  const Vector3 normal = plane.normal();
  const PlaneAxes axes = axes_of(normal);
  const Vector3 middle = model.centre_m / plane.q.dot(model.centre_m);
  const double distance = normal.dot(middle);
  Matrix3 slope;
  slope.col(0) = normal / (distance * distance);
  slope.col(1) = axes.first / distance - normal * (axes.first.dot(middle) / (distance * distance));
  slope.col(2) = axes.second / distance - normal * (axes.second.dot(middle) / (distance * distance));
  return slope;
}

// Effect of an error of that correction: turns, and the centre along its ray.
Matrix7 bias_noise(const RingModel& model, const Vector3& bias) {
  Vector7 moves = Vector7::Zero();
  moves[0] = -bias.z();
  moves[1] = bias.y();
  const double nearer = bias.x() / model.normal.dot(model.centre_m);
  moves.segment<3>(2) = nearer * model.centre_m;
  moves[5] = nearer * model.radius_m[0];
  moves[6] = nearer * model.radius_m[1];
  return kBiasSigma * kBiasSigma * moves * moves.transpose();
}

// The steepest points of both edges, searched about the model so far; false where they do not determine the ring.
bool refine_by_edges(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const PlaneFit& plane,
                     const RingPrior& prior, double search_px, RingFitWorkspace& workspace, RingFit& fit) {
  for (const RingEdge edge : kRingEdges) {
    fit.seen =
        find_ring_edges(frame, camera, rays, fit.model, edge, search_px, prior, workspace.points[index_of(edge)]);
  }
  const auto solved = solve_round(camera, fit.model, plane, workspace);
  if (!solved) return false;
  fit.model = moved(fit.model, axes_of(fit.model.normal), solved->step);
  if (!is_sane(fit.model)) return false;
  fit.covariance = solved->covariance;
  fit.edge_points = solved->edge_points;
  fit.edge_rms_px = std::sqrt(solved->edge_squares / solved->edge_points);
  fit.plane_chi2 = solved->plane_chi2;
  return true;
}

// All pixels about both edges in place of the edges' steepest points; false where too few are seen.
bool refine_by_light(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const PlaneFit& plane,
                     const RingPrior& prior, RingLightWorkspace& workspace, RingFit& fit) {
  const PlaneAxes axes = axes_of(fit.model.normal);
  const RingKnowledge known{plane_jacobian(fit.model, axes), plane.information, plane.plane.q - fit.model.plane().q,
                            q_by_bias(plane.plane, fit.model)};
  const auto light = fit_ring_light(frame, camera, rays, fit.model, prior, known, plane.margin_px, workspace);
  if (!light) return false;
  const RingModel model = moved(fit.model, axes, light->step);
  if (!is_sane(model)) return false;
  fit.model = model;
  fit.plane_chi2 = light->plane_chi2;
  fit.covariance = light->covariance * (fit.plane_chi2 > kDoubtful ? fit.plane_chi2 / 3.0 : 1.0);
  fit.covariance += bias_noise(model, light->plane_bias);
  fit.walls = light->walls;
  return true;
}

// Points of an ellipse's contour on a plane, and the circle through them.
struct PlanarCircle {
  Vector3 centre_m;
  double radius_m;
};

constexpr int kContourPoints = 32;

std::optional<PlanarCircle> circle_on_plane(const DepthPlane& plane, const RayGrid& rays,
                                            const ellipse::Ellipse& shape) {
  const PlaneAxes axes = axes_of(plane.normal());
  std::array<Vector3, kContourPoints> contour;
  Vector3 mean = Vector3::Zero();
  for (int k = 0; k < kContourPoints; ++k) {
    const ellipse::PointPx pixel = ellipse::point_at(shape, kTwoPi * k / kContourPoints);
    const Vector2 ray = rays.at(pixel.u, pixel.v);
    const double z = plane.z_m(ray);
    if (!(z > 0.0)) return std::nullopt;
    contour[static_cast<std::size_t>(k)] = z * Vector3(ray.x(), ray.y(), 1.0);
    mean += contour[static_cast<std::size_t>(k)] / kContourPoints;
  }
  // x^2 + y^2 = 2 a x + 2 b y + c about the mean: exact for points on a circle, which these nearly are.
  Matrix3 normal = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  for (const Vector3& point : contour) {
    const Vector3 row(2.0 * axes.first.dot(point - mean), 2.0 * axes.second.dot(point - mean), 1.0);
    normal += row * row.transpose();
    right += row * (point - mean).squaredNorm();
  }
  const auto inverse = positive_inverse<3>(normal);
  if (!inverse) return std::nullopt;
  const Vector3 circle = *inverse * right;
  const double square = circle.z() + circle.x() * circle.x() + circle.y() * circle.y();
  if (!circle.allFinite() || !(square > 0.0)) return std::nullopt;
  return PlanarCircle{mean + circle.x() * axes.first + circle.y() * axes.second, std::sqrt(square)};
}

}  // namespace

std::optional<RingModel> ring_on_plane(const DepthPlane& plane, const RayGrid& rays, const ellipse::Ellipse& outer,
                                       const ellipse::Ellipse& inner) {
  const auto wide = circle_on_plane(plane, rays, outer);
  const auto narrow = circle_on_plane(plane, rays, inner);
  if (!wide || !narrow) return std::nullopt;
  return RingModel{0.5 * (wide->centre_m + narrow->centre_m), plane.normal(), {wide->radius_m, narrow->radius_m}};
}

std::optional<RingFit> fit_ring(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                const PlaneFit& plane, const RingModel& start, double min_step_m,
                                const DepthNoise& noise, RingFitWorkspace& workspace) {
  RingFit fit;
  fit.model = start;
  // A plane with less scatter than the camera's noise still has pixels that are mixed with its surroundings.
  const double ratio = start.centre_m.z() / noise.range_m;
  const RingPrior prior{4.0 * std::max(plane.rms_m, noise.sigma_m * ratio * ratio), plane.amplitude, min_step_m};
  for (const double search_px : kSearch_px) {
    if (!refine_by_edges(frame, camera, rays, plane, prior, search_px, workspace, fit)) return std::nullopt;
  }
  if (!refine_by_light(frame, camera, rays, plane, prior, workspace.light, fit) &&
      !refine_by_edges(frame, camera, rays, plane, prior, kLastSearch_px, workspace, fit)) {
    return std::nullopt;
  }
  fit.covariance += common_noise(fit.model, noise.common_sigma_m) + common_place(camera, fit.model);
  fit.plane_rms_m = plane.rms_m;
  fit.amplitude = plane.amplitude;
  fit.plane_pixels = plane.pixels;
  return fit;
}

}  // namespace pharos::tof
