// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/ring2/face_on.hpp"

namespace pharos::ring2 {
namespace {

// Beyond this much more than the best, two steps from its own start, no second solution comes within
// kAmbiguousDeltaChi2.
constexpr double kAbandonExcessChi2 = 1000.0;
// Two solutions nearer than this are the same, converged from two sides: a ten-thousandth of a degree.
constexpr double kSameNormal_rad = 2e-6;
// As a fraction of the tilt's deviation: nearer minima are the same.
constexpr double kSameMinimum = 0.1;
// Ellipses of one rig disagree by noise and by calibration errors; half a pixel and five sigma are neither.
constexpr double kMaxRms_px = 0.5;
constexpr double kMaxChi2PerFreedom = 25.0;

// The problem's first and second circle.
struct Roles {
  Feature first = Feature::kRing;
  std::uint8_t unobservable = 0;
};

bool has(const ContourSet& contours, Feature feature) {
  const auto f = static_cast<std::size_t>(feature);
  return contours[0][f].has_value() || contours[1][f].has_value();
}

Roles roles_of(const ContourSet& contours) {
  Roles roles;
  const bool left = contours[0][0] || contours[0][1];
  const bool right = contours[1][0] || contours[1][1];
  if (!(left && right)) roles.unobservable |= kUnobservableScale;
  if (!has(contours, Feature::kRing)) {
    roles.first = Feature::kNozzle;
    roles.unobservable |= kUnobservableRing;
  }
  if (!has(contours, Feature::kNozzle)) roles.unobservable |= kUnobservableNozzle;
  return roles;
}

CircleProblem problem_of(const Rig& rig, const ContourSet& contours, const Roles& roles) {
  CircleProblem problem;
  problem.rig = rig;
  const auto first = static_cast<std::size_t>(roles.first);
  for (std::size_t v = 0; v < kViews; ++v) {
    problem.contours[v][0] = contours[v][first];
    if (roles.first == Feature::kRing) problem.contours[v][1] = contours[v][1];
  }
  problem.free.fill(true);
  problem.free[kRadius] = (roles.unobservable & kUnobservableScale) == 0;
  problem.free[kDistance] = problem.free[kSecondRadius] =
      (roles.unobservable & (kUnobservableRing | kUnobservableNozzle)) == 0;
  return problem;
}

std::optional<Ring2Failure> refusal_of(const Rig& rig, const ContourSet& contours) {
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
  int count = 0;
  for (const auto& view : contours) {
    for (const auto& contour : view) {
      if (!contour) continue;
      ++count;
      const bool informed = contour->information.allFinite() && contour->information.diagonal().minCoeff() > 0.0;
      if (!is_usable(contour->ellipse) || !informed) return Ring2Failure::kBadEllipse;
    }
  }
  if (count < 2) return Ring2Failure::kTooFewEllipses;
  return std::nullopt;
}

struct Minima {
  RefinedCircles best;
  std::optional<RefinedCircles> alternative;
};

double angle_of(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// Stores the best solution found, and one other minimum.
void take(const RefinedCircles& found, Minima& minima) {
  if (angle_of(found.model.normal, minima.best.model.normal) < kSameNormal_rad) return;
  const bool better = found.sums.cost < minima.best.sums.cost;
  const RefinedCircles other = better ? minima.best : found;
  if (better) minima.best = found;
  if (!minima.alternative || other.sums.cost < minima.alternative->sums.cost) minima.alternative = other;
}

std::optional<Minima> minima_of(const CircleProblem& problem, const ConeSet& cones) {
  std::optional<Minima> minima;
  for (const Vector3& normal : candidate_normals(problem, cones)) {
    const std::optional<CircleModel> start = model_along(problem, cones, normal);
    if (!start) continue;
    const double abandoned =
        minima ? minima->best.sums.cost + kAbandonExcessChi2 : std::numeric_limits<double>::infinity();
    const std::optional<RefinedCircles> found = refine(problem, *start, abandoned);
    if (!found) continue;
    if (minima) {
      take(*found, *minima);
    } else {
      minima = Minima{*found, std::nullopt};
    }
  }
  return minima;
}

bool disagrees(const NormalEquations& sums, int freedom) {
  return sums.largest_rms_px > kMaxRms_px && sums.cost > kMaxChi2PerFreedom * std::max(1, freedom);
}

// Whether the ellipses of the left view belong to the right and vice versa.
bool fits_exchanged(const Rig& rig, const ContourSet& contours, const Roles& roles) {
  const CircleProblem problem = problem_of(rig, {contours[1], contours[0]}, roles);
  const std::optional<ConeSet> cones = cones_of(problem);
  if (!cones) return false;
  const std::optional<Minima> minima = minima_of(problem, *cones);
  return minima && !disagrees(minima->best.sums, problem.degrees_of_freedom());
}

Ring2Estimate estimate_of(const CircleProblem& problem, const Roles& roles, const RefinedCircles& found,
                          const Matrix8& inverse) {
  Ring2Estimate estimate;
  const CircleModel& model = found.model;
  estimate.normal = model.normal;
  estimate.tilt_axes = tilt_axes(model.normal);
  estimate.unobservable = roles.unobservable;
  estimate.distance_m = model.distance_m;
  const bool ring = roles.first == Feature::kRing;
  (ring ? estimate.ring_centre_m : estimate.nozzle_centre_m) = model.centre_m;
  (ring ? estimate.ring_radius_m : estimate.nozzle_radius_m) = model.radius_m;
  if (ring) {
    estimate.nozzle_centre_m = model.centre_m + model.distance_m * model.normal;
    estimate.nozzle_radius_m = model.second_radius_m;
  }
  estimate.chi2 = found.sums.cost;
  estimate.degrees_of_freedom = problem.degrees_of_freedom();
  estimate.rms_px = found.sums.largest_rms_px;
  estimate.ellipses = problem.ellipses();
  estimate.iterations = found.iterations;
  const double per_freedom = estimate.chi2 / std::max(1, estimate.degrees_of_freedom);
  estimate.covariance = (per_freedom > kChancePerFreedom ? per_freedom : 1.0) * inverse;
  for (int i = 0; i < kUnknowns; ++i) {
    if (problem.free[static_cast<std::size_t>(i)]) continue;
    for (int j = 0; j < kUnknowns; ++j) estimate.covariance(i, j) = estimate.covariance(j, i) = 0.0;
  }
  return estimate;
}

void add_alternative(const Minima& minima, Ring2Estimate& estimate) {
  const double delta_chi2 = minima.alternative->sums.cost - minima.best.sums.cost;
  if (!(delta_chi2 < kAmbiguousDeltaChi2)) return;
  // Where the cost is flat, one minimum reached from two sides.
  const double apart = angle_of(minima.alternative->model.normal, estimate.normal);
  if (apart < kSameMinimum * estimate.sigma_normal_rad()) return;
  estimate.second = {minima.alternative->model.normal, minima.alternative->model.centre_m, delta_chi2};
}

// The mirrored minimum of circles that face the cameras: their ellipses' own pairs of normals are too noisy to start
// from.
void look_at_mirror(const CircleProblem& problem, const ConeSet& cones, Minima& minima) {
  const Vector3 sight = line_of_sight(problem, minima.best.model);
  const Vector3& normal = minima.best.model.normal;
  const std::optional<CircleModel> start =
      model_along(problem, cones, (2.0 * normal.dot(sight) * sight - normal).normalized());
  if (!start) return;
  const std::optional<RefinedCircles> found = refine(problem, *start, std::numeric_limits<double>::infinity());
  if (found) take(*found, minima);
}

// Where the cost is no parabola, the spread of all tilts; never less than the parabola's.
void widen(const CircleProblem& problem, const ConeSet& cones, Ring2Estimate& estimate, const CircleModel& model) {
  const double sigma_rad = estimate.sigma_normal_rad();
  const std::optional<Matrix2> spread = tilt_spread(problem, cones, model, estimate.chi2, sigma_rad);
  if (!spread || !(spread->trace() > sigma_rad * sigma_rad)) return;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j < 2; ++j) estimate.covariance(i, j) = estimate.covariance(j, i) = 0.0;
  }
  estimate.covariance.topLeftCorner<2, 2>() = *spread;
}

}  // namespace

const char* name_of(Ring2Failure failure) {
  switch (failure) {
    case Ring2Failure::kRigIntrinsics:
      return "rig_optics";
    case Ring2Failure::kRigRotation:
      return "rig_rotation";
    case Ring2Failure::kCamerasCoincide:
      return "cameras_coincide";
    case Ring2Failure::kTooFewEllipses:
      return "too_few_ellipses";
    case Ring2Failure::kBadEllipse:
      return "bad_ellipse";
    case Ring2Failure::kInconsistent:
      return "inconsistent";
    case Ring2Failure::kExchanged:
      return "left_right_exchanged";
    case Ring2Failure::kUndetermined:
      return "undetermined";
  }
  return "unknown";
}

Attitude attitude_of(const Vector3& normal) {
  return {std::atan2(normal.y(), -normal.z()), std::asin(std::clamp(-normal.x(), -1.0, 1.0))};
}

Vector3 normal_of(const Attitude& attitude) {
  const double facing = std::cos(attitude.gamma_rad);
  return {-std::sin(attitude.gamma_rad), std::sin(attitude.theta_rad) * facing, -std::cos(attitude.theta_rad) * facing};
}

double Ring2Estimate::sigma_normal_rad() const { return std::sqrt(covariance(0, 0) + covariance(1, 1)); }

Result<Ring2Estimate, Ring2Failure> solve_ring2(const Rig& rig, const ContourSet& contours) {
  if (const std::optional<Ring2Failure> refusal = refusal_of(rig, contours)) return *refusal;
  const Roles roles = roles_of(contours);
  const CircleProblem problem = problem_of(rig, contours, roles);
  if (problem.degrees_of_freedom() < 0) return Ring2Failure::kTooFewEllipses;
  const std::optional<ConeSet> cones = cones_of(problem);
  if (!cones) return Ring2Failure::kBadEllipse;
  std::optional<Minima> minima = minima_of(problem, *cones);
  if (!minima || disagrees(minima->best.sums, problem.degrees_of_freedom())) {
    return fits_exchanged(rig, contours, roles) ? Ring2Failure::kExchanged : Ring2Failure::kInconsistent;
  }
  auto inverse = positive_inverse<kUnknowns>(minima->best.sums.matrix);
  if (!inverse) return Ring2Failure::kUndetermined;
  Ring2Estimate estimate = estimate_of(problem, roles, minima->best, *inverse);
  if (is_face_on(problem, minima->best.model, estimate.sigma_normal_rad())) {
    look_at_mirror(problem, *cones, *minima);
    inverse = positive_inverse<kUnknowns>(minima->best.sums.matrix);
    if (!inverse) return Ring2Failure::kUndetermined;
    estimate = estimate_of(problem, roles, minima->best, *inverse);
    widen(problem, *cones, estimate, minima->best.model);
  }
  if (minima->alternative) add_alternative(*minima, estimate);
  return estimate;
}

}  // namespace pharos::ring2
