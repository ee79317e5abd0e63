// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/axis_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/pointing/tangent.hpp"

namespace pharos::pointing {
namespace {

constexpr int kRounds = 8;
// Steps of the mean over the plane's directions: 0.09 deg, finer than any sigma it is used for.
constexpr int kDirections = 2048;
// The linear result holds while its own curvature changes it by less than a tenth of itself.
constexpr double kLinearLimit = 0.1;
constexpr double kMinVariance = 1e-30;
constexpr double kUnitTolerance = 1e-6;

double variance_of(const AxisPlane& plane, const Vector3& direction) {
  return std::max(kMinVariance, direction.dot(plane.covariance * direction));
}

// The planes' common frame: `up` is normal to what they have in common, `first` and `second` lie in it.
struct CommonPlane {
  Vector3 up, first, second;
  Vector3 direction(double angle) const { return std::cos(angle) * first + std::sin(angle) * second; }
};

// A direction near `angle` of the common plane: its deviation from the plane for the best fit, and its chi2.
struct Candidate {
  double rise = 0.0;
  double rise_variance = 0.0;
  double chi2 = 0.0;
};

Candidate candidate_at(std::span<const AxisPlane> planes, const CommonPlane& common, const Vector3& direction) {
  double rr = 0.0, rb = 0.0, bb = 0.0;
  for (const AxisPlane& plane : planes) {
    const double weight = 1.0 / variance_of(plane, direction);
    const double r = plane.normal.dot(direction), b = plane.normal.dot(common.up);
    rr += weight * r * r;
    rb += weight * r * b;
    bb += weight * b * b;
  }
  return {-rb / bb, 1.0 / bb, std::max(0.0, rr - rb * rb / bb)};
}

CommonPlane common_plane(std::span<const AxisPlane> planes) {
  // Weights by the direction found so far; in the first round by the planes' largest sigmas.
  Vector3 direction = Vector3::Zero();
  CommonPlane common;
  for (int round = 0; round < kRounds; ++round) {
    Matrix3 sum = Matrix3::Zero();
    for (const AxisPlane& plane : planes) {
      const double worst = plane.worst_sigma_rad();
      const double variance = round == 0 ? std::max(kMinVariance, worst * worst) : variance_of(plane, direction);
      sum += plane.normal * plane.normal.transpose() / variance;
    }
    const SymmetricEigen<3> eigen = symmetric_eigen<3>(sum / sum.trace());
    common = {eigen.vectors.col(2), eigen.vectors.col(0), eigen.vectors.col(1)};
    direction = common.first;
  }
  return common;
}

// One plane from all, weighted by their largest sigmas: n = sum w n / |sum w n|.
AxisPlane mean_plane(std::span<const AxisPlane> planes, const Vector3& up) {
  Vector3 normal = Vector3::Zero();
  Matrix3 covariance = Matrix3::Zero();
  for (const AxisPlane& plane : planes) {
    const double worst = plane.worst_sigma_rad();
    const double weight = 1.0 / std::max(kMinVariance, worst * worst);
    normal += (plane.normal.dot(up) < 0.0 ? -weight : weight) * plane.normal;
    covariance += weight * weight * plane.covariance;
  }
  const double length = normal.norm();
  if (length <= 0.0) return {up, Matrix3::Identity()};
  normal /= length;
  const Matrix3 across = (Matrix3::Identity() - normal * normal.transpose()) / length;
  return {normal, across * covariance * across.transpose()};
}

// Angle along the common plane and its variance, in the neighbourhood of the minimum chi2.
struct Along {
  double angle = 0.0;
  double variance = 0.0;
  bool linear = false;
};

Along linear_answer(std::span<const AxisPlane> planes, const CommonPlane& common) {
  // Information of the two tangent directions at d = first.
  double ff = 0.0, fu = 0.0, uu = 0.0;
  for (const AxisPlane& plane : planes) {
    const double weight = 1.0 / variance_of(plane, common.first);
    const double f = plane.normal.dot(common.second), u = plane.normal.dot(common.up);
    ff += weight * f * f;
    fu += weight * f * u;
    uu += weight * u * u;
  }
  const double information = ff - fu * fu / uu;
  if (!(information > 0.0)) return {0.0, kPi * kPi, false};
  // Whether a linear result holds follows from the change of a plane's own sigma and of the information with the angle.
  const double sigma = std::sqrt(1.0 / information);
  double change = 1.0;
  for (const AxisPlane& plane : planes) {
    const double slope = 2.0 * common.second.dot(plane.covariance * common.first) / variance_of(plane, common.first);
    change = std::max(change, std::abs(slope));
  }
  return {0.0, sigma * sigma, sigma * change < kLinearLimit};
}

Along mean_over_directions(std::span<const AxisPlane> planes, const CommonPlane& common) {
  const auto angle_of = [](int k) { return kPi * k / kDirections; };
  std::array<double, kDirections> likelihood{};
  for (int k = 0; k < kDirections; ++k) {
    likelihood[static_cast<std::size_t>(k)] = candidate_at(planes, common, common.direction(angle_of(k))).chi2;
  }
  const double minimum = *std::min_element(likelihood.begin(), likelihood.end());
  // Twice the angle makes a full circle where the axis' half circle closes.
  double sum = 0.0, cosine = 0.0, sine = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    double& weight = likelihood[static_cast<std::size_t>(k)];
    weight = std::exp(-0.5 * (weight - minimum));
    sum += weight;
    cosine += weight * std::cos(2.0 * angle_of(k));
    sine += weight * std::sin(2.0 * angle_of(k));
  }
  Along along;
  along.angle = 0.5 * std::atan2(sine, cosine);
  double square = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    double off = angle_of(k) - along.angle;
    off -= kPi * std::round(off / kPi);
    square += likelihood[static_cast<std::size_t>(k)] * off * off;
  }
  along.variance = square / sum;
  return along;
}

// Largest sigma of the plane for any of its directions within 2 sigma of the axis.
double plausible_sigma(const AxisPlane& plane, const Vector3& axis, double sigma_along) {
  constexpr int kHalf = 16;
  const Vector3 side = plane.normal.cross(axis).normalized(), ahead = side.cross(plane.normal);
  const double reach = std::min(2.0 * sigma_along, 0.5 * kPi);
  double largest = 0.0;
  for (int k = -kHalf; k <= kHalf; ++k) {
    const double angle = reach * k / kHalf;
    largest = std::max(largest, plane.sigma_rad(std::cos(angle) * ahead + std::sin(angle) * side));
  }
  return largest;
}

bool is_usable(const AxisPlane& plane) {
  return plane.normal.allFinite() && plane.covariance.allFinite() &&
         std::abs(plane.normal.norm() - 1.0) < kUnitTolerance;
}

}  // namespace

double AxisEstimate::sigma_rad() const { return std::sqrt(std::max(0.0, covariance.trace())); }

const char* name_of(AxisFailure failure) {
  switch (failure) {
    case AxisFailure::kTooFewPlanes:
      return "too_few_planes";
    case AxisFailure::kNotFinite:
      return "not_finite";
  }
  return "";
}

Result<AxisEstimate, AxisFailure> estimate_axis(std::span<const AxisPlane> planes) {
  if (planes.size() < 2) return AxisFailure::kTooFewPlanes;
  if (!std::all_of(planes.begin(), planes.end(), is_usable)) return AxisFailure::kNotFinite;
  const CommonPlane common = common_plane(planes);
  Along along = linear_answer(planes, common);
  if (!along.linear) along = mean_over_directions(planes, common);
  const Vector3 direction = common.direction(along.angle);
  const Candidate candidate = candidate_at(planes, common, direction);
  AxisEstimate estimate;
  estimate.axis = (direction + candidate.rise * common.up).normalized();
  const Vector3 side = common.up.cross(estimate.axis).normalized(), rise = estimate.axis.cross(side);
  estimate.covariance = along.variance * side * side.transpose() + candidate.rise_variance * rise * rise.transpose();
  estimate.sigma_along_rad = std::sqrt(along.variance);
  estimate.plane = mean_plane(planes, common.up);
  estimate.sigma_plane_rad = plausible_sigma(estimate.plane, estimate.axis, estimate.sigma_along_rad);
  estimate.chi2 = candidate_at(planes, common, common.first).chi2;
  estimate.degrees_of_freedom = static_cast<int>(planes.size()) - 2;
  return estimate;
}

IntersectionJacobian intersection_jacobian(const Vector3& first, const Vector3& second) {
  const Vector3 cross = first.cross(second);
  const double length = cross.norm();
  const Vector3 axis = cross / length;
  const Matrix3 across = (Matrix3::Identity() - axis * axis.transpose()) / length;
  return {-across * skew(second), across * skew(first)};
}

}  // namespace pharos::pointing
