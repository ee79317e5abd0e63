// SPDX-License-Identifier: Apache-2.0
#pragma once

// PnP problems with known truth, and the error measures for their solutions. Tests, campaigns and benchmark use one
// generator and one validator, so that all of them use the same set.
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <random>

#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/pose/precision.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::test {

/// The paper's kind of target: a frustum within 125 x 125 x 62.5 mm, four sensors on the top plate and two on each
/// slanted face. Equal to data/target12/target.csv, so that tests need no data.
inline Target frustum_target() {
  constexpr double kNormalX = 0.894427191, kNormalZ = 0.447213595;
  struct Line {
    double x, y, z, nx, ny, nz;
  };
  constexpr std::array<Line, 12> kLines{{{-0.025, -0.025, 0.0625, 0, 0, 1},
                                         {-0.025, 0.025, 0.0625, 0, 0, 1},
                                         {0.025, -0.025, 0.0625, 0, 0, 1},
                                         {0.025, 0.025, 0.0625, 0, 0, 1},
                                         {0.055, 0.035, 0.015, kNormalX, 0, kNormalZ},
                                         {0.04, -0.015, 0.045, kNormalX, 0, kNormalZ},
                                         {-0.035, 0.055, 0.015, 0, kNormalX, kNormalZ},
                                         {0.015, 0.04, 0.045, 0, kNormalX, kNormalZ},
                                         {-0.055, -0.035, 0.015, -kNormalX, 0, kNormalZ},
                                         {-0.04, 0.015, 0.045, -kNormalX, 0, kNormalZ},
                                         {0.035, -0.055, 0.015, 0, -kNormalX, kNormalZ},
                                         {-0.015, -0.04, 0.045, 0, -kNormalX, kNormalZ}}};
  Target target;
  std::uint8_t number = 0;
  for (const Line& l : kLines) target.push_back({number++, {l.x, l.y, l.z}, {l.nx, l.ny, l.nz}});
  return target;
}

/// The four sensors of the top plate: exactly coplanar.
inline Target top_plate_target() {
  Target target = frustum_target();
  target.resize(4);
  return target;
}

struct PnpSet {
  double sigma_rad = kPaperSigma_rad;
  double rho = 0.0;
  int min_sensors = 4, max_sensors = 8;
  double min_range_m = 1.0, max_range_m = 5.0;
  double half_field_rad = 60.0 * kRadPerDeg;  // of each angle from straight ahead
  /// Views in which all visible sensors are coplanar: a separate class, in which the wrong pose may fit better.
  bool coplanar_views = true;
};

struct PnpProblem {
  LighthouseFromBody truth;
  pose::Observations observations;
  std::bitset<kMaxSensors> seen;
};

/// Bearing of a point in the lighthouse frame on one axis.
inline double bearing_of(const Vector3& p, Axis axis) { return std::atan2(p.z(), p[index_of(axis)]); }

class PnpGenerator {
 public:
  PnpGenerator(const Target& target, const PnpSet& set, std::uint64_t seed)
      : target_(target), set_(set), engine_(seed) {}

  /// The next problem whose number of visible sensors is in the set's range.
  PnpProblem next() {
    PnpProblem problem;
    do {
      problem.truth = random_pose();
      problem.seen = pose::visible_sensors(target_, problem.truth, pose::kVisibleIncidence_rad);
    } while (!wanted(problem.seen));
    observe(problem);
    return problem;
  }

  /// New noise on the same view.
  void observe(PnpProblem& problem) {
    problem.observations.clear();
    const std::array<double, kAxes> common{normal(), normal()};
    for (const SensorPlacement& s : target_) {
      if (!problem.seen.test(s.sensor)) continue;
      for (const Axis axis : {Axis::kX, Axis::kY}) {
        const double noise = std::sqrt(set_.rho) * common[static_cast<std::size_t>(index_of(axis))] +
                             std::sqrt(1.0 - set_.rho) * normal();
        problem.observations.push_back(
            {s.sensor, axis, bearing_of(problem.truth * s.position_m, axis) + set_.sigma_rad * noise});
      }
    }
  }

  bool wanted(const std::bitset<kMaxSensors>& seen) const {
    const int count = static_cast<int>(seen.count());
    if (count < set_.min_sensors || count > set_.max_sensors) return false;
    if (set_.coplanar_views) return true;
    Target view;
    for (const SensorPlacement& s : target_) {
      if (seen.test(s.sensor)) view.push_back(s);
    }
    const auto shape = check_target(view);
    return shape.ok() && !shape->coplanar;
  }

  double normal() { return std::normal_distribution<double>()(engine_); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::mt19937_64& engine() { return engine_; }

  LighthouseFromBody random_pose() {
    const double x = std::tan(uniform(-set_.half_field_rad, set_.half_field_rad));
    const double y = std::tan(uniform(-set_.half_field_rad, set_.half_field_rad));
    LighthouseFromBody pose;
    pose.t = uniform(set_.min_range_m, set_.max_range_m) * Vector3(x, y, 1.0).normalized();
    // One draw a statement: compilers differ in the order of arguments, and a seed must give the same problems on all.
    const double qz = normal();
    const double qy = normal();
    const double qx = normal();
    const double qw = normal();
    pose.R = Quaternion(qw, qx, qy, qz).normalized().toRotationMatrix();
    return pose;
  }

 private:
  Target target_;
  PnpSet set_;
  std::mt19937_64 engine_;
};

/// Normalised estimation error squared: delta^T C^-1 delta, 6 in the mean where the covariance is consistent.
inline double nees_of(const LighthouseFromBody& truth, const LighthousePoseEstimate& estimate) {
  const Vector6 delta = pose_difference(truth, estimate.pose);
  return mahalanobis_squared<6>(delta, estimate.covariance);
}

/// Errors of many solutions relative to the truth, compared with the Cramer-Rao bound (angles with white noise, at the
/// truth).
struct PnpScore {
  static constexpr double kFailure_rad = 10.0 * kRadPerDeg;

  int problems = 0, refused = 0, failures = 0, ambiguous = 0, wrong_unflagged = 0;
  // Of the solutions that are not failures: squares of errors, of their bounds, and of the ratio of the two.
  double rotation_square = 0.0, position_square = 0.0;
  double rotation_bound_square = 0.0, position_bound_square = 0.0;
  double rotation_ratio_square = 0.0, position_ratio_square = 0.0;

  void add_refusal() {
    ++problems;
    ++refused;
  }
  void add(const PnpProblem& problem, const LighthouseFromBody& estimate, bool flagged, const Matrix6& bound) {
    ++problems;
    ambiguous += flagged ? 1 : 0;
    const double angle = rotation_angle_between(estimate.R, problem.truth.R);
    if (angle > kFailure_rad) {
      ++failures;
      wrong_unflagged += flagged ? 0 : 1;
      return;
    }
    const double distance_square = (estimate.t - problem.truth.t).squaredNorm();
    const double rotation_bound = bound.topLeftCorner<3, 3>().trace();
    const double position_bound = bound.bottomRightCorner<3, 3>().trace();
    rotation_square += angle * angle;
    position_square += distance_square;
    rotation_bound_square += rotation_bound;
    position_bound_square += position_bound;
    rotation_ratio_square += angle * angle / rotation_bound;
    position_ratio_square += distance_square / position_bound;
  }

  int answers() const { return problems - refused - failures; }
  /// x CRB: root mean square of each error over its own bound; 1 is optimal. Every view has the same weight.
  double rotation_over_bound() const { return std::sqrt(rotation_ratio_square / answers()); }
  double position_over_bound() const { return std::sqrt(position_ratio_square / answers()); }
  /// The same with the squares summed first: dominated by a few nearly singular views (bounds of 50 deg).
  double rotation_rms_over_bound() const { return std::sqrt(rotation_square / rotation_bound_square); }
  double position_rms_over_bound() const { return std::sqrt(position_square / position_bound_square); }
};

/// Cramer-Rao bound of a problem's pose.
inline Matrix6 bound_of(const Target& target, const PnpProblem& problem, double sigma_rad) {
  const auto precision = pose::precision_of(target, problem.truth, problem.seen, 0.0);
  return precision.ok() ? Matrix6(precision->unit_covariance * (sigma_rad * sigma_rad)) : Matrix6::Zero();
}

}  // namespace pharos::test
