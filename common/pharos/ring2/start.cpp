// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/start.hpp"

#include <algorithm>
#include <limits>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::ring2 {
namespace {

// Up to eight: two of each ellipse.
struct Candidate {
  std::array<Vector3, 2> normals;
  double weight;  // large ellipses determine more
};
using Candidates = StaticVector<Candidate, 4>;

Candidates candidates_of(const CircleProblem& problem, const ConeSet& cones) {
  Candidates candidates;
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (!cones[v][c]) continue;
      const auto poses = circle_poses(*cones[v][c]);
      if (!poses) continue;
      const double a_px = problem.contours[v][c]->ellipse.a_px;
      candidates.push_back({{(*poses)[0].normal, (*poses)[1].normal}, a_px * a_px});
    }
  }
  return candidates;
}

std::size_t nearer_of(const Candidate& candidate, const Vector3& normal) {
  return candidate.normals[0].dot(normal) >= candidate.normals[1].dot(normal) ? 0 : 1;
}

double disagreement(const Candidates& candidates, const Vector3& normal) {
  double sum = 0.0;
  for (const Candidate& candidate : candidates) {
    sum += candidate.weight * (candidate.normals[nearer_of(candidate, normal)] - normal).squaredNorm();
  }
  return sum;
}

// Columns: centre, radius, distance, second radius.
constexpr int kLinear = 6;
using Matrix6x6 = Eigen::Matrix<double, kLinear, kLinear>;

struct LinearSums {
  Matrix6x6 matrix = Matrix6x6::Zero();
  Vector6 right = Vector6::Zero();
};

// centre [+ distance normal] - radius direction / radius_per_range = camera's centre; three rows.
void add_apparent_circle(const ApparentCircle& apparent, const Vector3& camera_m, const Vector3& normal, bool second,
                         LinearSums& sums) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector6 row = Vector6::Zero();
    row[axis] = 1.0;
    row[second ? 5 : 3] = -apparent.direction[axis] / apparent.radius_per_range;
    if (second) row[4] = normal[axis];
    add_outer<kLinear>(sums.matrix, row, 1.0);
    for (int i = 0; i < kLinear; ++i) sums.right[i] += row[i] * camera_m[axis];
  }
}

// An unknown that is not free keeps the value `held`.
void hold(int unknown, double held, LinearSums& sums) {
  for (int i = 0; i < kLinear; ++i) {
    sums.right[i] -= sums.matrix(i, unknown) * held;
    sums.matrix(i, unknown) = sums.matrix(unknown, i) = i == unknown ? 1.0 : 0.0;
  }
  sums.right[unknown] = held;
}

}  // namespace

std::optional<ConeSet> cones_of(const CircleProblem& problem) {
  ConeSet cones;
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (!problem.contours[v][c]) continue;
      cones[v][c] = cone_of(problem.contours[v][c]->ellipse, problem.rig.views[v]);
      if (!cones[v][c]) return std::nullopt;
    }
  }
  return cones;
}

StaticVector<Vector3, 2> candidate_normals(const CircleProblem& problem, const ConeSet& cones) {
  const Candidates candidates = candidates_of(problem, cones);
  StaticVector<Vector3, 2> normals;
  if (candidates.empty()) return normals;
  double minimum = std::numeric_limits<double>::infinity();
  Vector3 best = candidates[0].normals[0];
  for (const Candidate& candidate : candidates) {
    for (const Vector3& normal : candidate.normals) {
      const double sum = disagreement(candidates, normal);
      if (sum < minimum) {
        minimum = sum;
        best = normal;
      }
    }
  }
  Vector3 alternative = best;
  minimum = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates) {
    const Vector3& other = candidate.normals[1 - nearer_of(candidate, best)];
    const double sum = disagreement(candidates, other);
    if (sum < minimum) {
      minimum = sum;
      alternative = other;
    }
  }
  normals.push_back(best);
  normals.push_back(alternative);
  return normals;
}

std::optional<CircleModel> model_along(const CircleProblem& problem, const ConeSet& cones, const Vector3& normal) {
  LinearSums sums;
  for (std::size_t v = 0; v < kViews; ++v) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (!cones[v][c]) continue;
      const std::optional<ApparentCircle> apparent = apparent_circle(*cones[v][c], normal);
      if (!apparent) return std::nullopt;
      add_apparent_circle(*apparent, problem.rig.views[v].T_rig_camera.t, normal, c == 1, sums);
    }
  }
  if (!problem.free[kRadius]) hold(3, 1.0, sums);
  if (!problem.free[kDistance]) hold(4, 0.0, sums);
  if (!problem.free[kSecondRadius]) hold(5, 0.0, sums);
  const auto inverse = positive_inverse<kLinear>(sums.matrix);
  if (!inverse) return std::nullopt;
  const Vector6 x = *inverse * sums.right;
  CircleModel model{normal, x.head<3>(), x[3], x[4], x[5]};
  const bool positive = model.radius_m > 0.0 && (!problem.free[kSecondRadius] || model.second_radius_m > 0.0);
  if (!x.allFinite() || !positive) return std::nullopt;
  return model;
}

}  // namespace pharos::ring2
