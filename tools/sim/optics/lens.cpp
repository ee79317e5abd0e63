// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/lens.hpp"

#include <algorithm>

namespace pharos::sim {
namespace {

constexpr int kMaxSteps = 20;
constexpr double kConverged = 1e-13;  // before the last step, which is quadratic: then to rounding
// Beyond the radius where the distortion folds over (determinant 0) a solution exists but is not physical.
constexpr double kMinDeterminant = 0.1;

// Central differences of a polynomial of degree 7: exact to 1e-9 of the slope, enough for Newton's method.
constexpr double kStep = 1e-5;

Eigen::Matrix2d slope_of(const Lens& lens, const Vector2& ray) {
  Eigen::Matrix2d slope;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2 h = kStep * Vector2::Unit(axis);
    slope.col(axis) = (distorted(lens, ray + h) - distorted(lens, ray - h)) / (2.0 * kStep);
  }
  return slope;
}

}  // namespace

Lens centred_lens(std::int32_t width_px, std::int32_t height_px, double focal_px) {
  return {width_px, height_px, focal_px, focal_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1), {}};
}

bool has_distortion(const Lens& lens) {
  return std::any_of(lens.distortion.begin(), lens.distortion.end(), [](double term) { return term != 0.0; });
}

std::optional<Vector2> undistorted(const Lens& lens, const Vector2& seen, const Vector2& start) {
  if (!has_distortion(lens)) return seen;
  Vector2 ray = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector2 miss = seen - distorted(lens, ray);
    const Eigen::Matrix2d slope = slope_of(lens, ray);
    if (slope.determinant() < kMinDeterminant) return std::nullopt;
    ray += slope.inverse() * miss;
    if (miss.norm() < kConverged) return ray;
  }
  return std::nullopt;
}

}  // namespace pharos::sim
