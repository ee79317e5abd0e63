// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/face_on.hpp"

#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::ring2 {
namespace {

// In deviations of the tilt: within so many of the line of sight, both its sides are tried.
constexpr double kNear = 6.0;
// Tilts on either side of the line of sight, in each of two directions.
constexpr int kSteps = 6;

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// Minimum chi2 with the normal held.
std::optional<double> chi2_at(const CircleProblem& held, const ConeSet& cones, const Vector3& normal) {
  const std::optional<CircleModel> model = model_along(held, cones, normal);
  if (!model) return std::nullopt;
  const std::optional<NormalEquations> sums = linearise(held, *model);
  if (!sums) return std::nullopt;
  const auto inverse = positive_inverse<kUnknowns>(sums->matrix);
  if (!inverse) return std::nullopt;
  double chi2 = sums->cost;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j < kUnknowns; ++j) chi2 -= sums->gradient[i] * (*inverse)(i, j) * sums->gradient[j];
  }
  return chi2;
}

}  // namespace

Vector3 line_of_sight(const CircleProblem& problem, const CircleModel& model) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t v = 0; v < kViews; ++v) {
    if (!problem.contours[v][0] && !problem.contours[v][1]) continue;
    sum += (problem.rig.views[v].T_rig_camera.t - model.centre_m).normalized();
  }
  return sum.normalized();
}

bool is_face_on(const CircleProblem& problem, const CircleModel& model, double sigma_rad) {
  return angle_between(model.normal, line_of_sight(problem, model)) < kNear * sigma_rad;
}

std::optional<Matrix2> tilt_spread(const CircleProblem& problem, const ConeSet& cones, const CircleModel& model,
                                   double chi2, double sigma_rad) {
  CircleProblem held = problem;
  held.free[kTilt] = held.free[kTilt + 1] = false;
  const Vector3 sight = line_of_sight(problem, model);
  const std::array<Vector3, 2> around = tilt_axes(sight);
  const std::array<Vector3, 2> axes = tilt_axes(model.normal);
  const double step_rad = (angle_between(model.normal, sight) + 4.0 * sigma_rad) / kSteps;
  Matrix2 sum = Matrix2::Zero();
  double weights = 0.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Vector3 normal = (sight + step_rad * (i * around[0] + j * around[1])).normalized();
      const std::optional<double> there = chi2_at(held, cones, normal);
      if (!there) continue;
      const double weight = std::exp(-0.5 * (*there - chi2));
      const Vector3 turn = model.normal.cross(normal);
      const Vector2 tilt(turn.dot(axes[0]), turn.dot(axes[1]));
      sum += weight * tilt * tilt.transpose();
      weights += weight;
    }
  }
  if (!(weights > 0.0) || !std::isfinite(weights)) return std::nullopt;
  return Matrix2(sum / weights);
}

}  // namespace pharos::ring2
