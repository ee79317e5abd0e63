// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/spin.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "pharos/base/static_vector.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/optimize/descent.hpp"
#include "pharos/optimize/least_squares.hpp"
#include "pharos/pointing/axis_estimate.hpp"
#include "pharos/pointing/tangent.hpp"

namespace pharos::pointing {
namespace {

constexpr int kSpinDirections = 500;       // of half the sphere: some 6 deg apart
constexpr std::size_t kSearchPlanes = 64;  // the search uses so many planes, spread over the pass
constexpr std::size_t kStarts = 24;        // best of the search, each refined
constexpr int kMaxIterations = 40;
// Of chi2, by which a last step may still lower it: the square of a ten-thousandth of a standard deviation.
constexpr double kConverged = 1e-8;
// Remaining fraction of one parameter's information once all others are free too: below it the parameter is unknown.
constexpr double kMinCondition = 1e-14;
constexpr double kSameAxis = 5.0;  // sigmas
// Spin axis and rate are three unknowns more than a fixed axis has. Minimum decrease of chi2 for a spin to be accepted:
// its 99.99 % quantile for three.
constexpr double kSeenChi2 = 21.1;

struct Start {
  Spin spin;
  double cost = 0.0;
};
using Starts = StaticVector<Start, kStarts>;

double axis_variance(const AxisPlane& plane, const Vector3& d) { return std::max(1e-30, d.dot(plane.covariance * d)); }

// Stores the best; starts are in order of directions, so one of each direction is enough.
void keep(Starts& starts, const Start& start) {
  if (starts.push_back(start)) return;
  Start* worst =
      std::max_element(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  if (start.cost < worst->cost) *worst = start;
}

struct SpinProblem {
  std::span<const AxisPlane> planes;
  std::span<const double> seconds;
};

// For a given motion the axis is the direction that all planes, rotated back, have in common.
Start best_axis(const SpinProblem& problem, const Vector3& spin, double rate) {
  const std::size_t count = problem.planes.size(), stride = (count + kSearchPlanes - 1) / kSearchPlanes;
  Matrix3 sum = Matrix3::Zero();
  for (std::size_t i = 0; i < count; i += stride) {
    const double angle = -rate * problem.seconds[i], c = std::cos(angle), s = std::sin(angle);
    const Vector3& n = problem.planes[i].normal;
    const Vector3 back = c * n + s * spin.cross(n) + (1.0 - c) * spin.dot(n) * spin;
    sum += back * back.transpose();
  }
  const SymmetricEigen<3> eigen = symmetric_eigen<3>(sum);
  return {{eigen.vectors.col(0), spin, rate}, eigen.values[0]};
}

Starts search(const SpinProblem& problem, double max_rate) {
  const auto [first, last] = std::minmax_element(problem.seconds.begin(), problem.seconds.end());
  const double duration = std::max(1e-9, *last - *first);
  const int rates = std::max(1, static_cast<int>(std::ceil(max_rate * duration)));
  Starts starts;
  for (int k = 0; k < kSpinDirections; ++k) {
    // Points of equal area along a spiral over the upper half of the sphere.
    const double z = (k + 0.5) / kSpinDirections, turn = k * kPi * (3.0 - std::sqrt(5.0));
    const double out = std::sqrt(1.0 - z * z);
    const Vector3 spin(out * std::cos(turn), out * std::sin(turn), z);
    Start best;
    for (int r = -rates; r <= rates; ++r) {
      const Start start = best_axis(problem, spin, max_rate * r / rates);
      if (r == -rates || start.cost < best.cost) best = start;
    }
    keep(starts, best);
  }
  return starts;
}

// Planes against a rotating axis; chi-squared over the five of Spin::moved_by.
struct SpinDescent : optimize::LeastSquares<5, Spin> {
  static constexpr double kFirstDamping = 1e-3;  // from a grid of 6 deg the undamped step may go to another minimum

  explicit SpinDescent(const SpinProblem& m) : problem(m) {}

  Normal linearise(const Spin& spin) const {
    Normal normal;
    for (std::size_t i = 0; i < problem.planes.size(); ++i) {
      const AxisPlane& plane = problem.planes[i];
      const Vector3 d = spin.at(problem.seconds[i]);
      normal.add(spin_jacobian(spin, plane.normal, problem.seconds[i]).transpose(), plane.normal.dot(d),
                 1.0 / axis_variance(plane, d));
    }
    return normal;
  }
  Spin moved(const Spin& spin, const Delta& delta) const { return spin.moved_by(delta); }

  SpinProblem problem;
};

Start refined(const SpinProblem& problem, const Spin& spin) {
  optimize::Descent<SpinDescent> d;
  optimize::descend(SpinDescent(problem), spin, {kMaxIterations, kConverged}, d);
  return {d.state, d.normal.cost};
}

// Scaled to a diagonal of ones, so that parameters in rad and in rad/s count equally.
bool is_inverse_sound(const Matrix5& information, Matrix5& covariance) {
  const Eigen::Matrix<double, 5, 1> scale = information.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(scale.minCoeff() > 0.0)) return false;
  const Matrix5 scales = scale * scale.transpose();
  const Eigen::LDLT<Matrix5> factors(information.cwiseQuotient(scales));
  if (!(factors.vectorD().minCoeff() > kMinCondition)) return false;
  // Column by column: Eigen's solver for matrices keeps a static of cache sizes.
  for (Eigen::Index k = 0; k < 5; ++k) {
    const Eigen::Matrix<double, 5, 1> unit = Eigen::Matrix<double, 5, 1>::Unit(k);
    covariance.col(k) = factors.solve(unit).cwiseQuotient(scales.col(k));
  }
  return covariance.allFinite();
}

}  // namespace

Vector3 Spin::at(double seconds) const { return rotation_exp(spin * (rate_rad_s * seconds)) * axis; }

Spin Spin::moved_by(const Eigen::Matrix<double, 5, 1>& delta) const {
  const Tangent of_axis = tangent_of(axis), of_spin = tangent_of(spin);
  return {(axis + delta[0] * of_axis.first + delta[1] * of_axis.second).normalized(),
          (spin + delta[2] * of_spin.first + delta[3] * of_spin.second).normalized(), rate_rad_s + delta[4]};
}

Row5 spin_jacobian(const Spin& spin, const Vector3& normal, double seconds) {
  const double angle = spin.rate_rad_s * seconds, c = std::cos(angle), s = std::sin(angle);
  const Tangent of_axis = tangent_of(spin.axis), of_spin = tangent_of(spin.spin);
  const Vector3& w = spin.spin;
  // d = c a + s w x a + (1 - c) (w . a) w
  const auto by_axis = [&](const Vector3& a) {
    return normal.dot(Vector3(c * a + s * w.cross(a) + (1.0 - c) * w.dot(a) * w));
  };
  const auto by_spin = [&](const Vector3& u) {
    return normal.dot(Vector3(s * u.cross(spin.axis) + (1.0 - c) * (u.dot(spin.axis) * w + w.dot(spin.axis) * u)));
  };
  const Vector3 d = spin.at(seconds);
  Row5 J;
  J << by_axis(of_axis.first), by_axis(of_axis.second), by_spin(of_spin.first), by_spin(of_spin.second),
      seconds * normal.dot(w.cross(d));
  return J;
}

Result<SpinEstimate, SpinFailure> fit_spin(std::span<const AxisPlane> planes, std::span<const double> seconds,
                                           double max_rate_rad_s) {
  if (planes.size() < kMinSpinPlanes || seconds.size() != planes.size()) return SpinFailure::kTooFewPlanes;
  const SpinProblem problem{planes, seconds};
  Starts starts = search(problem, max_rate_rad_s);
  Start best;
  best.cost = -1.0;
  for (Start& start : starts) {
    start = refined(problem, start.spin);
    if (best.cost < 0.0 || start.cost < best.cost) best = start;
  }
  SpinEstimate estimate;
  estimate.spin = best.spin;
  estimate.chi2 = best.cost;
  estimate.degrees_of_freedom = static_cast<int>(planes.size()) - 5;
  const auto still = estimate_axis(planes);
  const double per_freedom = std::max(1.0, best.cost / estimate.degrees_of_freedom);
  if (still && still->chi2 - best.cost < kSeenChi2 * per_freedom) return SpinFailure::kNotSeen;
  if (!is_inverse_sound(SpinDescent(problem).linearise(best.spin).matrix, estimate.covariance)) {
    return SpinFailure::kNotSeen;
  }
  const Tangent tangent = tangent_of(best.spin.axis);
  Eigen::Matrix<double, 3, 2> J;
  J << tangent.first, tangent.second;
  estimate.axis_covariance = J * estimate.covariance.topLeftCorner<2, 2>() * J.transpose();
  const double sigma = std::sqrt(estimate.axis_covariance.trace());
  for (const Start& start : starts) {
    const double delta = start.cost - best.cost;
    const double apart = start.spin.axis.cross(best.spin.axis).norm();
    if (delta >= kAmbiguousDeltaChi2 || apart < kSameAxis * sigma) continue;
    if (estimate.second && delta >= estimate.second_delta_chi2) continue;
    estimate.second = start.spin;
    estimate.second_delta_chi2 = delta;
  }
  return estimate;
}

}  // namespace pharos::pointing
