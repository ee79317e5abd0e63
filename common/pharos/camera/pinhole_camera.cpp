// SPDX-License-Identifier: Apache-2.0
#include "pharos/camera/pinhole_camera.hpp"

#include <cmath>

namespace pharos {
namespace {

// Newton's method doubles its digits: where more steps are needed the lens has no such pixel.
constexpr int kMaxSteps = 20;
constexpr double kConverged = 1e-12;
// Fraction of a lens without distortion below which the Jacobian's determinant counts as a fold.
constexpr double kMinStretch = 1e-3;

Vector2 distorted(const std::array<double, 5>& d, const Vector2& ray) {
  const auto [k1, k2, p1, p2, k3] = d;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Matrix2 distorted_jacobian(const std::array<double, 5>& d, const Vector2& ray) {
  const auto [k1, k2, p1, p2, k3] = d;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // of radial with r2, twice
  const double mixed = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  Matrix2 jacobian;
  jacobian << radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed,  //
      mixed, radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return jacobian;
}

bool folds(const Matrix2& jacobian) { return !(jacobian.determinant() > kMinStretch && jacobian.trace() > 0.0); }

}  // namespace

const char* name_of(CameraFailure failure) {
  switch (failure) {
    case CameraFailure::kBehindCamera:
      return "behind_camera";
    case CameraFailure::kOutsideModel:
      return "outside_lens_model";
    case CameraFailure::kNotConverged:
      return "undistortion_not_converged";
  }
  return "unknown";
}

bool is_usable(const PinholeCamera& camera) {
  bool finite = std::isfinite(camera.fx_px) && std::isfinite(camera.fy_px) && std::isfinite(camera.cx_px) &&
                std::isfinite(camera.cy_px);
  for (const double term : camera.distortion) finite = finite && std::isfinite(term);
  return finite && camera.width_px > 0 && camera.height_px > 0 && camera.fx_px > 0.0 && camera.fy_px > 0.0;
}

Vector2 distort(const PinholeCamera& camera, const Vector2& ray) {
  const Vector2 bent = distorted(camera.distortion, ray);
  return {camera.fx_px * bent.x() + camera.cx_px, camera.fy_px * bent.y() + camera.cy_px};
}

Matrix2 distort_jacobian(const PinholeCamera& camera, const Vector2& ray) {
  return Vector2(camera.fx_px, camera.fy_px).asDiagonal() * distorted_jacobian(camera.distortion, ray);
}

Result<Vector2, CameraFailure> undistort(const PinholeCamera& camera, const Vector2& pixel) {
  const Vector2 bent((pixel.x() - camera.cx_px) / camera.fx_px, (pixel.y() - camera.cy_px) / camera.fy_px);
  Vector2 ray = bent;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Matrix2 jacobian = distorted_jacobian(camera.distortion, ray);
    if (folds(jacobian)) return CameraFailure::kOutsideModel;
    const Vector2 change = jacobian.inverse() * (bent - distorted(camera.distortion, ray));
    ray += change;
    if (!ray.allFinite()) return CameraFailure::kNotConverged;
    if (change.squaredNorm() < kConverged * kConverged) {
      if (folds(distorted_jacobian(camera.distortion, ray))) return CameraFailure::kOutsideModel;
      return ray;
    }
  }
  return CameraFailure::kNotConverged;
}

Result<Vector2, CameraFailure> project(const PinholeCamera& camera, const Vector3& point) {
  if (!(point.z() > 0.0)) return CameraFailure::kBehindCamera;
  const Vector2 ray(point.x() / point.z(), point.y() / point.z());
  if (folds(distorted_jacobian(camera.distortion, ray))) return CameraFailure::kOutsideModel;
  return distort(camera, ray);
}

Matrix23 project_jacobian(const PinholeCamera& camera, const Vector3& point) {
  const double inverse_z = 1.0 / point.z();
  const Vector2 ray(point.x() * inverse_z, point.y() * inverse_z);
  Matrix23 ray_by_point;
  ray_by_point << inverse_z, 0.0, -ray.x() * inverse_z, 0.0, inverse_z, -ray.y() * inverse_z;
  return distort_jacobian(camera, ray) * ray_by_point;
}

}  // namespace pharos
