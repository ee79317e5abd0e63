// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/station_model.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::lighthouse {
namespace {

// The correction reduces an error by tilt and curve (below 0.1 for every plausible station), so a dozen steps reach
// double precision; more mean that it does not converge.
constexpr int kMaxSteps = 24;
constexpr double kConverged_rad = 1e-11;
// Nearer than this to the edge of the half space ahead, tan is too large to use.
constexpr double kEdge_rad = 1e-3;

bool is_ahead(double theta_rad) { return theta_rad > kEdge_rad && theta_rad < kPi - kEdge_rad; }

double clamped_asin(double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); }

double form1(const RotorCalibration& c, double ax, double ay, double o_over_r) {
  double g = ax + kPi / 2 - c.phase_rad - clamped_asin(c.tilt_rad * o_over_r);
  g -= c.gibbous_magnitude_rad * std::cos(c.gibbous_phase_rad + g);
  return g + c.curve_rad * ay * ay;
}

double form2(const RotorCalibration& c, double ax, double ay, double o_over_r) {
  return kPi / 2 + ax - clamped_asin(o_over_r * std::tan(c.tilt_rad)) - c.phase_rad +
         c.gibbous_magnitude_rad * std::sin(ax + c.gibbous_phase_rad) - c.curve_rad * ay * ay;
}

// Raw theta of the direction with the ideal bearings `swept` (this axis) and `other`, both ahead.
double raw_from_ideal(const RotorCalibration& calibration, ModelForm form, Axis axis, double swept, double other) {
  const double swept_slope = std::tan(kPi / 2 - swept);  // x/z on axis x, y/z (down) on axis y
  const double other_slope = std::tan(kPi / 2 - other);
  // o is Y (up) for axis x and X (right) for axis y; frame L has y down.
  const double o = axis == Axis::kX ? -other_slope : other_slope;
  const double o_over_r = o / std::hypot(swept_slope, 1.0);
  const double ax = swept - kPi / 2;
  const double ay = std::atan(o);
  return form == ModelForm::kForm1 ? form1(calibration, ax, ay, o_over_r) : form2(calibration, ax, ay, o_over_r);
}

}  // namespace

ThetaPair ideal_thetas(const Vector3& p) {
  return {kPi / 2 - std::atan2(p.x(), p.z()), kPi / 2 - std::atan2(p.y(), p.z())};
}

Vector3 direction_of(const ThetaPair& ideal) {
  return Vector3(std::tan(kPi / 2 - ideal.x_rad), std::tan(kPi / 2 - ideal.y_rad), 1.0).normalized();
}

double raw_theta(const StationCalibration& station, ModelForm form, Axis axis, const Vector3& p_lighthouse) {
  return raw_theta(station, form, axis, ideal_thetas(p_lighthouse));
}

double raw_theta(const StationCalibration& station, ModelForm form, Axis axis, const ThetaPair& ideal) {
  const Axis other = axis == Axis::kX ? Axis::kY : Axis::kX;
  return raw_from_ideal(station[axis], form, axis, ideal[axis], ideal[other]);
}

std::optional<double> ideal_from_raw(const StationCalibration& station, ModelForm form, Axis axis, double raw_rad,
                                     double other_ideal_rad) {
  if (!is_ahead(raw_rad) || !is_ahead(other_ideal_rad)) return std::nullopt;
  double swept = raw_rad;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double correction = raw_rad - raw_from_ideal(station[axis], form, axis, swept, other_ideal_rad);
    swept += correction;
    if (!is_ahead(swept)) return std::nullopt;
    if (std::abs(correction) < kConverged_rad) return swept;
  }
  return std::nullopt;
}

std::optional<ThetaPair> ideal_from_raw(const StationCalibration& station, ModelForm form, const ThetaPair& raw) {
  if (!is_ahead(raw.x_rad) || !is_ahead(raw.y_rad)) return std::nullopt;
  ThetaPair ideal = raw;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double dx = raw.x_rad - raw_from_ideal(station[Axis::kX], form, Axis::kX, ideal.x_rad, ideal.y_rad);
    const double dy = raw.y_rad - raw_from_ideal(station[Axis::kY], form, Axis::kY, ideal.y_rad, ideal.x_rad);
    ideal.x_rad += dx;
    ideal.y_rad += dy;
    if (!is_ahead(ideal.x_rad) || !is_ahead(ideal.y_rad)) return std::nullopt;
    if (std::max(std::abs(dx), std::abs(dy)) < kConverged_rad) return ideal;
  }
  return std::nullopt;
}

}  // namespace pharos::lighthouse
