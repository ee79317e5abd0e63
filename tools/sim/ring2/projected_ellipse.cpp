// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ring2/projected_ellipse.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pharos/geometry/symmetric.hpp"

namespace pharos::sim {
namespace {

constexpr double kPi = std::numbers::pi;
// Places at which a contour is sampled to measure its length: 3e-6 of a step of one pixel.
constexpr int kDense = 2880;

using Matrix2 = Eigen::Matrix<double, 2, 2>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

// Two unit vectors across a direction.
std::array<Vector3, 2> across(const Vector3& direction) {
  const Vector3 helper = std::abs(direction.x()) < 0.5 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 first = (helper - helper.dot(direction) * direction).normalized();
  return {first, direction.cross(first)};
}

ImageEllipse from_shape(const Vector2& centre, const Matrix2& shape) {
  const double mean = 0.5 * (shape(0, 0) + shape(1, 1));
  const double half = 0.5 * (shape(0, 0) - shape(1, 1));
  const double difference = std::hypot(half, shape(0, 1));
  double theta = 0.5 * std::atan2(shape(0, 1), half);
  if (theta <= -0.5 * kPi) theta += kPi;
  return {centre.x(), centre.y(), std::sqrt(mean + difference), std::sqrt(mean - difference), theta};
}

// Without the lens distortion: conic of the homography from the circle's plane to the image.
ImageEllipse ellipse_of_conic(const StereoCamera& camera, const SpaceCircle& circle) {
  const auto [e1, e2] = across(circle.normal);
  Matrix3 plane;  // (x, y, 1), the circle being x^2 + y^2 = 1, to the camera's frame
  const Matrix3 R = camera.R_rig_camera.transpose();
  plane << R * (circle.radius_m * e1), R * (circle.radius_m * e2), R * (circle.centre_m - camera.t_rig_camera_m);
  Matrix3 K;
  K << camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0;
  const Matrix3 H = K * plane;
  // The dual conic needs no inverse: C* = H diag(1, 1, -1) H^T; its last column is the centre's multiple.
  const Matrix3 dual = H * Vector3(1.0, 1.0, -1.0).asDiagonal() * H.transpose();
  const Vector2 centre = dual.block<2, 1>(0, 2) / dual(2, 2);
  const Matrix2 shape = centre * centre.transpose() - dual.block<2, 2>(0, 0) / dual(2, 2);
  return from_shape(centre, shape);
}

Vector3 point_on(const SpaceCircle& circle, const std::array<Vector3, 2>& axes, double angle) {
  return circle.centre_m + circle.radius_m * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]);
}

// Centre and lower triangle L: points are centre + L (cos t, sin t). No pole at the circle.
struct Triangle {
  Vector2 centre;
  Matrix2 L;
};

Triangle triangle_of(const ImageEllipse& e) {
  const double c = std::cos(e.theta_rad);
  const double s = std::sin(e.theta_rad);
  Matrix2 axes;
  axes << e.a_px * c, -e.b_px * s, e.a_px * s, e.b_px * c;
  const Matrix2 shape = axes * axes.transpose();
  return {{e.cx_px, e.cy_px}, shape.llt().matrixL()};
}

// Anomaly of the contour's point next to `point`.
double foot_of(const Triangle& ellipse, const Vector2& point) {
  const Vector2 from_centre = point - ellipse.centre;
  const Vector2 unit = ellipse.L.triangularView<Eigen::Lower>().solve(from_centre);
  double t = std::atan2(unit.y(), unit.x());
  for (int k = 0; k < 4; ++k) {
    const Vector2 along(-std::sin(t), std::cos(t));
    const Vector2 out(std::cos(t), std::sin(t));
    const Vector2 left = from_centre - ellipse.L * out;
    const Vector2 tangent = ellipse.L * along;
    const double slope = -tangent.squaredNorm() - left.dot(ellipse.L * out);
    t -= left.dot(tangent) / slope;
  }
  return t;
}

}  // namespace

std::optional<Vector2> pixel_of(const StereoCamera& camera, const Vector3& point_rig_m) {
  const Vector3 p = camera.R_rig_camera.transpose() * (point_rig_m - camera.t_rig_camera_m);
  if (p.z() <= 0.0) return std::nullopt;
  return pixel_of(static_cast<const Lens&>(camera), p);
}

std::vector<Vector2> contour_points(const StereoCamera& camera, const SpaceCircle& circle, int points) {
  const auto axes = across(circle.normal);
  std::vector<Vector2> dense;
  std::vector<double> length{0.0};
  for (int k = 0; k <= kDense; ++k) {
    const std::optional<Vector2> pixel = pixel_of(camera, point_on(circle, axes, 2.0 * kPi * k / kDense));
    if (!pixel) return {};
    if (k > 0) length.push_back(length.back() + (*pixel - dense.back()).norm());
    dense.push_back(*pixel);
  }
  const int count = points > 0 ? points : std::max(6, static_cast<int>(std::lround(length.back())));
  std::vector<Vector2> even;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double at = length.back() * i / count;
    while (length[k + 1] <= at) ++k;
    const double angle = 2.0 * kPi * (static_cast<double>(k) + (at - length[k]) / (length[k + 1] - length[k])) / kDense;
    even.push_back(*pixel_of(camera, point_on(circle, axes, angle)));
  }
  return even;
}

ImageEllipse fitted_ellipse(const ImageEllipse& start, std::span<const Vector2> points) {
  Triangle now = triangle_of(start);
  for (int iteration = 0; iteration < 50; ++iteration) {
    Matrix5 normal = Matrix5::Zero();
    Vector5 right = Vector5::Zero();
    for (const Vector2& point : points) {
      const double t = foot_of(now, point);
      const Vector2 out(std::cos(t), std::sin(t));
      const Vector2 tangent = now.L * Vector2(-out.y(), out.x());
      const Vector2 across_it = Vector2(tangent.y(), -tangent.x()).normalized();
      const double distance = across_it.dot(point - now.centre - now.L * out);
      Vector5 row;
      row << across_it.x(), across_it.y(), across_it.x() * out.x(), across_it.y() * out.x(), across_it.y() * out.y();
      normal += row * row.transpose();
      right += row * distance;
    }
    const Vector5 step = solve_symmetric<5>(normal, right);
    now.centre += step.head<2>();
    now.L(0, 0) += step[2];
    now.L(1, 0) += step[3];
    now.L(1, 1) += step[4];
    if (step.cwiseAbs().maxCoeff() < 1e-11) break;
  }
  return from_shape(now.centre, now.L * now.L.transpose());
}

std::optional<ImageEllipse> projected_ellipse(const StereoCamera& camera, const SpaceCircle& circle) {
  const auto axes = across(circle.normal);
  for (int k = 0; k < 16; ++k) {
    if (!pixel_of(camera, point_on(circle, axes, 2.0 * kPi * k / 16))) return std::nullopt;
  }
  const ImageEllipse ideal = ellipse_of_conic(camera, circle);
  if (!has_distortion(camera)) return ideal;
  const std::vector<Vector2> points = contour_points(camera, circle);
  if (points.empty()) return std::nullopt;
  return fitted_ellipse(ideal, points);
}

std::optional<ImageEllipse> noisy_ellipse(const StereoCamera& camera, const SpaceCircle& circle, double sigma_px,
                                          RandomStream& random, int& points) {
  const std::optional<ImageEllipse> start = projected_ellipse(camera, circle);
  if (!start) return std::nullopt;
  std::vector<Vector2> edge = contour_points(camera, circle);
  points = static_cast<int>(edge.size());
  const std::vector<Vector2> clean = edge;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Vector2 tangent = clean[(i + 1) % clean.size()] - clean[(i + clean.size() - 1) % clean.size()];
    edge[i] += sigma_px * random.normal() * Vector2(tangent.y(), -tangent.x()).normalized();
  }
  return fitted_ellipse(*start, edge);
}

}  // namespace pharos::sim
