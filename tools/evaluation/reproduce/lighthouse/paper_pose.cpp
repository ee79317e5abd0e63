// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/paper_pose.hpp"

#include <cmath>

#include "pharos/geometry/rotation.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/pose/dlt.hpp"
#include "pharos/pose/paper.hpp"
#include "pharos/pose/rpnp.hpp"

namespace pharos::tools::paper002 {
namespace {

constexpr std::size_t kMinSensors = 4;
constexpr int kMaxIterations = 100;
// The cost stands still: what is left is far below the noise.
constexpr double kStandstill = 1e-6;
constexpr double kFirstDamping = 1e-3, kDampingFactor = 10.0, kMaxDamping = 1e12;
// "Where necessary" a more robust start: the tangents are off by more than any noise or calibration error.
constexpr double kFarFromBearings = 5e-3;

// (4): R(phi) of (5) is passive.
struct Psi {
  Vector3 phi_rad, t_m;
};

struct Normal {
  double cost = 0.0;
  Matrix6 squares = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  bool ahead = true;
};

// (6), (7), (11), (12).
Normal normal_of(const Target& target, const std::vector<SensorAngles>& angles, const Psi& psi) {
  Normal normal;
  for (const SensorAngles& one : angles) {
    const Vector3& body_m = find_sensor(target, one.sensor)->position_m;
    const Vector3 p = pose::paper::point(psi.phi_rad, psi.t_m, body_m);
    normal.ahead = normal.ahead && p.z() > 0.0;
    const Vector2 f = pose::paper::residual(p, one.theta_rad);
    const pose::paper::Matrix26 J = pose::paper::residual_jacobian(psi.phi_rad, psi.t_m, body_m);
    normal.cost += f.squaredNorm();
    normal.squares += J.transpose() * J;
    normal.right += J.transpose() * f;
  }
  return normal;
}

pose::RaySet rays_of(const Target& target, const std::vector<SensorAngles>& angles) {
  pose::RaySet rays;
  for (const SensorAngles& one : angles) {
    const auto k = static_cast<std::size_t>(rays.count++);
    rays.body[k] = find_sensor(target, one.sensor)->position_m;
    rays.ray[k] = Vector3(1.0 / std::tan(one.theta_rad.x()), 1.0 / std::tan(one.theta_rad.y()), 1.0).normalized();
  }
  return rays;
}

std::optional<PaperPose> best_from(const Target& target, const std::vector<SensorAngles>& angles,
                                   const pose::StartPoses& starts) {
  std::optional<PaperPose> best;
  for (const LighthouseFromBody& start : starts) {
    const auto found = descend(target, angles, start);
    if (found && (!best || found->residual_rms < best->residual_rms)) best = found;
  }
  return best;
}

}  // namespace

std::optional<PaperPose> descend(const Target& target, const std::vector<SensorAngles>& angles,
                                 const LighthouseFromBody& start) {
  Psi psi{-rotation_log(start.R), start.t};
  Normal normal = normal_of(target, angles, psi);
  if (!std::isfinite(normal.cost)) return std::nullopt;
  double damping = kFirstDamping;
  PaperPose result;
  while (result.iterations < kMaxIterations && damping < kMaxDamping) {
    Matrix6 damped = normal.squares;
    damped.diagonal() *= 1.0 + damping;
    const Vector6 step = -solve_symmetric<6>(damped, normal.right);
    const Psi next{psi.phi_rad + step.head<3>(), psi.t_m + step.tail<3>()};
    const Normal there = normal_of(target, angles, next);
    if (!(there.cost < normal.cost)) {
      // At the minimum no step helps any more.
      if (step.norm() < 1e-12) break;
      damping *= kDampingFactor;
      continue;
    }
    const double gained = normal.cost - there.cost;
    psi = next;
    normal = there;
    ++result.iterations;
    damping /= kDampingFactor;
    if (gained < kStandstill * normal.cost) break;
  }
  if (!normal.ahead || !std::isfinite(normal.cost)) return std::nullopt;
  result.pose.R = paper_rotation(psi.phi_rad);
  result.pose.t = psi.t_m;
  result.residual_rms = std::sqrt(normal.cost / (2.0 * static_cast<double>(angles.size())));
  return result;
}

std::optional<PaperPose> solve_by_paper(const Target& target, const std::vector<SensorAngles>& angles) {
  if (angles.size() < kMinSensors) return std::nullopt;
  const pose::RaySet rays = rays_of(target, angles);
  auto by_dlt = best_from(target, angles, pose::dlt(rays));
  if (by_dlt) by_dlt->started_by_dlt = true;
  if (by_dlt && by_dlt->residual_rms < kFarFromBearings) return by_dlt;
  const auto by_rpnp = best_from(target, angles, pose::rpnp(rays));
  if (!by_rpnp) return by_dlt;
  return by_dlt && by_dlt->residual_rms <= by_rpnp->residual_rms ? by_dlt : by_rpnp;
}

}  // namespace pharos::tools::paper002
