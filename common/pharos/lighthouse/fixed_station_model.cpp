// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/fixed_station_model.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::lighthouse {
namespace {

using fixed::kOne;
using fixed::Q30;
using fixed::times;

constexpr Q30 q30(double value) { return static_cast<Q30>(value * kOne); }

// The error of the series below is less than 1e-9 up to here; real stations stay within a quarter of it.
constexpr double kLargestPhase_rad = 0.125, kLargestTilt_rad = 0.03125, kLargestOther_rad = 0.03125;
/// Where the cosine of a bearing from straight ahead falls below 1/8.
constexpr Q30 kWidest = q30(1.44);
/// The step after one this small would be a thirtieth of it at the most: 8e-9 rad.
constexpr Q30 kConverged = 256;
constexpr int kMaxFixedSteps = 12;
constexpr std::int64_t kQuarterTurn = static_cast<std::int64_t>(kPi / 2 * kOne);

fixed::SineCosine any_sine_cosine(double angle_rad) {
  const double folded = std::remainder(angle_rad, 2 * kPi);
  if (folded > kPi / 2 || folded < -kPi / 2) {
    const fixed::SineCosine sc =
        fixed::sine_cosine(static_cast<Q30>(fixed::from_double(folded > 0 ? kPi - folded : -kPi - folded, 30)));
    return {sc.sine, -sc.cosine};
  }
  return fixed::sine_cosine(static_cast<Q30>(fixed::from_double(folded, 30)));
}

// From straight ahead.
std::int64_t from_ahead(double theta_rad) { return fixed::from_double(theta_rad, 30) - kQuarterTurn; }

bool wide(std::int64_t angle) { return angle > kWidest || angle < -kWidest; }

}  // namespace

std::optional<FixedStationModel::Rotor> FixedStationModel::rotor_of(const RotorCalibration& c, ModelForm form) {
  const bool small = std::fabs(c.phase_rad) < kLargestPhase_rad && std::fabs(c.tilt_rad) < kLargestTilt_rad &&
                     std::fabs(c.curve_rad) < kLargestOther_rad &&
                     std::fabs(c.gibbous_magnitude_rad) < kLargestOther_rad && std::fabs(c.gibbous_phase_rad) < 1e3;
  if (!small) return std::nullopt;
  Rotor rotor;
  rotor.phase = static_cast<Q30>(fixed::from_double(c.phase_rad, 30));
  rotor.tilt = static_cast<Q30>(fixed::from_double(c.tilt_rad, 30));
  if (form == ModelForm::kForm2) rotor.tilt += times(times(rotor.tilt, rotor.tilt), rotor.tilt / 3);  // its tangent
  rotor.curve = static_cast<Q30>(fixed::from_double(form == ModelForm::kForm1 ? c.curve_rad : -c.curve_rad, 30));
  rotor.magnitude = static_cast<Q30>(fixed::from_double(c.gibbous_magnitude_rad, 30));
  rotor.gibbous = any_sine_cosine(c.gibbous_phase_rad);
  return rotor;
}

FixedStationModel::FixedStationModel(const StationCalibration& station, ModelForm form)
    : station_(station), form_(form) {
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    const auto rotor = rotor_of(station[axis], form);
    usable_ = usable_ && rotor.has_value();
    if (rotor) rotor_[static_cast<std::size_t>(index_of(axis))] = *rotor;
  }
}

Q30 FixedStationModel::raw_of(const Rotor& rotor, const Angle& swept, const Angle& other, int sign) const {
  // With angles from straight ahead, o = sign tan(other), o / r = o cos(swept) and ay^2 = other^2.
  const std::int32_t tangent = times(fixed::reciprocal(other.sc.cosine), other.sc.sine);  // Q27
  const std::int32_t o_over_r = sign * times(tangent, swept.sc.cosine);
  const auto sine = static_cast<Q30>(fixed::product(o_over_r, rotor.tilt) >> 27);
  const Q30 tilt = sine + times(times(sine, sine), sine / 6);
  const Q30 off = -rotor.phase - tilt;
  // The angle in the gibbous term: form 1's has the other terms in it.
  fixed::SineCosine g = swept.sc;
  if (form_ == ModelForm::kForm1) {
    const Q30 square = times(off, off);
    const Q30 s = off - times(square, off / 6);
    const Q30 c = kOne - square / 2 + times(square, square / 24);
    g = {times(swept.sc.sine, c) + times(swept.sc.cosine, s), times(swept.sc.cosine, c) - times(swept.sc.sine, s)};
  }
  const Q30 gibbous = times(rotor.magnitude, times(rotor.gibbous.sine, g.cosine) + times(rotor.gibbous.cosine, g.sine));
  const Q30 quarter = times(other.angle / 2, other.angle / 2);
  return swept.angle + off + gibbous + static_cast<Q30>(fixed::product(rotor.curve, quarter) >> 28);
}

std::optional<ThetaPair> FixedStationModel::ideal_from_raw(const ThetaPair& raw) {
  const std::int64_t wide_x = from_ahead(raw.x_rad), wide_y = from_ahead(raw.y_rad);
  if (!usable_ || wide(wide_x) || wide(wide_y)) {
    return lighthouse::ideal_from_raw(station_, form_, raw);
  }
  const auto raw_x = static_cast<Q30>(wide_x), raw_y = static_cast<Q30>(wide_y);
  Q30 x = raw_x + last_x_, y = raw_y + last_y_;
  for (int step = 0; step < kMaxFixedSteps && !wide(x) && !wide(y); ++step) {
    const Angle angle_x{x, fixed::sine_cosine(x)}, angle_y{y, fixed::sine_cosine(y)};
    const Q30 dx = raw_x - raw_of(rotor_[0], angle_x, angle_y, 1);
    const Q30 dy = raw_y - raw_of(rotor_[1], angle_y, angle_x, -1);
    x += dx;
    y += dy;
    if (dx <= kConverged && dx >= -kConverged && dy <= kConverged && dy >= -kConverged) {
      last_x_ = x - raw_x;
      last_y_ = y - raw_y;
      return ThetaPair{fixed::to_double(x + kQuarterTurn, 30), fixed::to_double(y + kQuarterTurn, 30)};
    }
  }
  return lighthouse::ideal_from_raw(station_, form_, raw);
}

std::optional<double> FixedStationModel::ideal_from_raw(Axis axis, double raw_rad, double across_ideal_rad) const {
  const std::int64_t wide_raw = from_ahead(raw_rad), wide_across = from_ahead(across_ideal_rad);
  if (usable_ && !wide(wide_raw) && !wide(wide_across)) {
    const auto raw = static_cast<Q30>(wide_raw), other = static_cast<Q30>(wide_across);
    const Angle across{other, fixed::sine_cosine(other)};
    Q30 swept = raw + (axis == Axis::kX ? last_x_ : last_y_);
    for (int step = 0; step < kMaxFixedSteps && !wide(swept); ++step) {
      const Q30 correction = raw - raw_of(rotor_[static_cast<std::size_t>(index_of(axis))],
                                          {swept, fixed::sine_cosine(swept)}, across, axis == Axis::kX ? 1 : -1);
      swept += correction;
      if (correction <= kConverged && correction >= -kConverged) return fixed::to_double(swept + kQuarterTurn, 30);
    }
  }
  return lighthouse::ideal_from_raw(station_, form_, axis, raw_rad, across_ideal_rad);
}

}  // namespace pharos::lighthouse
