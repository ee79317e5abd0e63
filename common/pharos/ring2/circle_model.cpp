// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/circle_model.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::ring2 {
namespace {

// Points of a circle that are projected. A contour's offsets have few harmonics: 12 points determine them without
// distortion, 16 with that of a wide lens.
constexpr int kPoints = 16;
// cos and sin of k / 16 of a full circle; nothing is computed at run time.
constexpr double kHalf = 0.70710678118654752440;
constexpr double kCos1 = 0.92387953251128675613;
constexpr double kSin1 = 0.38268343236508977173;
constexpr std::array<double, kPoints> kCosine{1.0,  kCos1,  kHalf,  kSin1,  0.0, -kSin1, -kHalf, -kCos1,
                                              -1.0, -kCos1, -kHalf, -kSin1, 0.0, kSin1,  kHalf,  kCos1};

// Means along the contour, weighted by its length.
struct Means {
  Matrix5 slopes = Matrix5::Zero();                                         // slope slope^T
  Vector5 offsets = Vector5::Zero();                                        // slope offset
  Eigen::Matrix<double, 5, 8> cross = Eigen::Matrix<double, 5, 8>::Zero();  // slope (d offset / d unknowns)
  double length = 0.0;
};

// One point, with the derivatives of its offset by the unknowns.
void add_point(const Contour::Offset& offset, const Vector8& by_unknowns, double weight, Means& means) {
  for (int i = 0; i < 5; ++i) {
    const double scaled = weight * offset.slope[i];
    for (int j = 0; j <= i; ++j) means.slopes(i, j) += scaled * offset.slope[j];
    means.offsets[i] += scaled * offset.distance_px;
    for (int j = 0; j < kUnknowns; ++j) means.cross(i, j) += scaled * by_unknowns[j];
  }
  means.length += weight;
}

struct Placed {
  Vector3 centre_m;
  double radius_m;
  std::array<Vector3, 2> axes;
};

Placed placed(const CircleModel& model, Circle circle) {
  if (circle == Circle::kFirst) return {model.centre_m, model.radius_m, tilt_axes(model.normal)};
  return {model.centre_m + model.distance_m * model.normal, model.second_radius_m, tilt_axes(model.normal)};
}

std::optional<Means> means_along(const CircleModel& model, Circle circle, const RigView& view, const Contour& contour) {
  const Placed at = placed(model, circle);
  const Matrix3 R_camera_rig = view.T_rig_camera.R.transpose();
  Means means;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double cosine = kCosine[k];
    const double sine = kCosine[(k + kPoints - kPoints / 4) % kPoints];
    const Vector3 outwards = cosine * at.axes[0] + sine * at.axes[1];
    const Vector3 along = cosine * at.axes[1] - sine * at.axes[0];
    const Vector3 point_m = at.centre_m + at.radius_m * outwards;
    const Vector3 point_camera_m = R_camera_rig * (point_m - view.T_rig_camera.t);
    const Result<Vector2, CameraFailure> pixel = project(view.intrinsics, point_camera_m);
    if (!pixel) return std::nullopt;
    const Matrix23 by_point = project_jacobian(view.intrinsics, point_camera_m) * R_camera_rig;
    const Contour::Offset offset = contour.offset_of(*pixel);
    const Vector3 pull = by_point.transpose() * offset.normal;
    const Vector3 turn = (point_m - model.centre_m).cross(pull);
    const bool second = circle == Circle::kSecond;
    Vector8 by_unknowns;
    by_unknowns << at.axes[0].dot(turn), at.axes[1].dot(turn), pull, second ? 0.0 : pull.dot(outwards),
        second ? pull.dot(model.normal) : 0.0, second ? pull.dot(outwards) : 0.0;
    add_point(offset, by_unknowns, (by_point * along).norm(), means);
  }
  return means;
}

}  // namespace

std::array<Vector3, 2> tilt_axes(const Vector3& normal) {
  // The rig's axis farthest from the normal is never parallel to it.
  Eigen::Index minimum = 0;
  normal.cwiseAbs().minCoeff(&minimum);
  const Vector3 first = normal.cross(Vector3(Vector3::Unit(minimum))).normalized();
  return {first, normal.cross(first)};
}

CircleModel moved(const CircleModel& model, const Vector8& step) {
  const std::array<Vector3, 2> axes = tilt_axes(model.normal);
  CircleModel next = model;
  next.normal = (model.normal + (step[0] * axes[0] + step[1] * axes[1]).cross(model.normal)).normalized();
  next.centre_m += step.segment<3>(kCentre);
  next.radius_m += step[kRadius];
  next.distance_m += step[kDistance];
  next.second_radius_m += step[kSecondRadius];
  return next;
}

std::optional<ShapeResidual> shape_residual(const CircleModel& model, Circle circle, const RigView& view,
                                            const Contour& contour) {
  std::optional<Means> means = means_along(model, circle, view, contour);
  if (!means) return std::nullopt;
  for (int i = 0; i < 5; ++i) {
    for (int j = i + 1; j < 5; ++j) means->slopes(i, j) = means->slopes(j, i);
  }
  const auto inverse = positive_inverse<5>(means->slopes);
  if (!inverse) return std::nullopt;
  ShapeResidual residual;
  residual.value = *inverse * means->offsets;
  for (int j = 0; j < kUnknowns; ++j) residual.slope.col(j) = *inverse * means->cross.col(j);
  residual.rms_px = std::sqrt(std::max(0.0, residual.value.dot(means->offsets) / means->length));
  return residual;
}

bool add_ellipse(const CircleModel& model, Circle circle, const RigView& view, const Contour& contour,
                 NormalEquations& sums) {
  const std::optional<ShapeResidual> residual = shape_residual(model, circle, view, contour);
  if (!residual) return false;
  const Vector5 pulled = contour.information * residual->value;
  sums.cost += residual->value.dot(pulled);
  sums.largest_rms_px = std::max(sums.largest_rms_px, residual->rms_px);
  for (int j = 0; j < kUnknowns; ++j) {
    sums.gradient[j] += residual->slope.col(j).dot(pulled);
    const Vector5 weighed = contour.information * residual->slope.col(j);
    for (int i = 0; i < kUnknowns; ++i) sums.matrix(i, j) += residual->slope.col(i).dot(weighed);
  }
  return true;
}

}  // namespace pharos::ring2
