// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_model.hpp"

#include <algorithm>

namespace pharos::lighthouse {
namespace {

constexpr int kMaxDirectionSteps = 12;
constexpr double kDirectionConverged_rad = 1e-11;
constexpr double kSmallest_z = 1e-3;  // of a unit direction: nearer to the edge of the half space ahead is refused

std::array<double, 7> fields_of(const PlaneCalibration& c) {
  return {c.phase_rad,      c.tilt_rad,      c.curve, c.gibbous_phase_rad, c.gibbous_magnitude_rad,
          c.ogee_phase_rad, c.ogee_magnitude};
}

/// A value and its derivatives by x, y, z.
struct Dual {
  double value = 0.0;
  Vector3 by = Vector3::Zero();

  Dual() = default;
  explicit Dual(double v) : value(v) {}
  Dual(double v, const Vector3& d) : value(v), by(d) {}
  Dual operator-() const { return {-value, -by}; }
  bool operator<(const Dual& o) const { return value < o.value; }
  bool operator>(const Dual& o) const { return value > o.value; }
};

Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.by + b.by}; }
Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.by - b.by}; }
Dual operator*(const Dual& a, const Dual& b) { return {a.value * b.value, a.by * b.value + b.by * a.value}; }
Dual operator/(const Dual& a, const Dual& b) {
  const double q = a.value / b.value;
  return {q, (a.by - q * b.by) / b.value};
}
Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.by}; }
Dual cos(const Dual& a) { return {std::cos(a.value), -std::sin(a.value) * a.by}; }
Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.value);
  return {root, a.by / (2.0 * root)};
}
Dual asin(const Dual& a) {
  const double cosine = std::sqrt(std::max(1e-12, 1.0 - a.value * a.value));
  return {std::asin(a.value), a.by / cosine};
}
Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value), (x.value * y.by - y.value * x.by) / square};
}

Dual dual_angle(const PlaneCalibration& calibration, std::size_t plane, const Vector3& p) {
  std::array<Dual, 7> field;
  const std::array<double, 7> values = fields_of(calibration);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = Dual(values[k]);
  return lh2::angle<Dual>(plane, field, {p.x(), Vector3::UnitX()}, {p.y(), Vector3::UnitY()},
                          {p.z(), Vector3::UnitZ()});
}

}  // namespace

double lh2_angle(const PlaneCalibration& calibration, std::size_t plane, const Vector3& p) {
  return lh2::angle<double>(plane, fields_of(calibration), p.x(), p.y(), p.z());
}

IdealPlaneAngle ideal_lh2_angle(std::size_t plane, const Vector3& p) {
  const double tan_t = (plane == 0 ? -1.0 : 1.0) * 0.57735026918962576;
  const double square = p.x() * p.x() + p.z() * p.z();
  const double r = std::sqrt(square);
  const double sine = std::clamp(-p.y() * tan_t / r, -1.0, 1.0);
  const double by_sine = 1.0 / std::sqrt(std::max(1e-12, 1.0 - sine * sine));
  IdealPlaneAngle out;
  out.angle_rad = std::atan2(-p.x(), p.z()) + std::asin(sine);
  // atan2(-x, z): (-z, x)/square by (x, z); sine: -tan/r by y, -sine x/square by x, -sine z/square by z.
  out.gradient = {-p.z() / square - by_sine * sine * p.x() / square, -by_sine * tan_t / r,
                  p.x() / square - by_sine * sine * p.z() / square};
  return out;
}

Vector3 lh2_gradient(const PlaneCalibration& calibration, std::size_t plane, const Vector3& p) {
  return dual_angle(calibration, plane, p).by;
}

std::optional<Vector3> lh2_direction(const Lh2Calibration& calibration, const PlaneAngles& angles) {
  // Start from the ideal planes: the azimuth is the mean, the elevation comes from the difference.
  const double azimuth = 0.5 * (angles[0] + angles[1]);
  const double sine = std::clamp(std::sin(0.5 * (angles[1] - angles[0])), -0.9, 0.9);
  const double height = sine / 0.57735026918962576;  // over r
  Vector3 p(-std::sin(azimuth), -height, std::cos(azimuth));
  for (int step = 0; step < kMaxDirectionSteps; ++step) {
    if (!(p.z() > kSmallest_z * p.norm()) || !p.allFinite()) return std::nullopt;
    // Unknown: x and y at z = 1.
    p /= p.z();
    std::array<Dual, kPlanes> shown;
    for (std::size_t k = 0; k < kPlanes; ++k) shown[k] = dual_angle(calibration.plane[k], k, p);
    const double a = shown[0].by.x(), b = shown[0].by.y(), c = shown[1].by.x(), d = shown[1].by.y();
    const double determinant = a * d - b * c;
    if (!(std::abs(determinant) > 1e-9)) return std::nullopt;
    const double e0 = angles[0] - shown[0].value, e1 = angles[1] - shown[1].value;
    const double dx = (d * e0 - b * e1) / determinant, dy = (a * e1 - c * e0) / determinant;
    const double scale = std::min(1.0, 0.5 / std::max(1e-12, std::hypot(dx, dy)));
    p.x() += scale * dx;
    p.y() += scale * dy;
    if (std::max(std::abs(e0), std::abs(e1)) < kDirectionConverged_rad) return p.normalized();
  }
  return std::nullopt;
}

}  // namespace pharos::lighthouse
