// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/base/axis.hpp"
#include "pharos/geometry/types.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::lighthouse {

// Two angles of one sensor are distinguished here:
//   ideal theta   the paper's theta (002, equations 1-2): x/z = cot(theta_x), y/z = cot(theta_y), pi/2 straight ahead;
//   raw theta     what a real rotor shows: 2 pi (hit - flash) / revolution.
// A rotor's five parameters map one to the other. Source: the public Lighthouse 1.0 model, in the station's own frame X
// right, Y up, looking along -Z; frame L is that frame rotated by pi about X.
//
// With a = X, o = Y, s = -1 for axis x and a = Y, o = X, s = +1 for axis y, Z' = -Z,
// ax = s atan2(a, Z'), ay = atan2(o, Z'), r = hypot(a, Z'):
//   form 1: g = ax + pi/2 - phase - asin(tilt o / r);  g -= gibmag cos(gibphase + g);  raw = g + curve ay^2
//   form 2: raw = pi/2 + ax - asin(o tan(tilt) / r) - phase + gibmag sin(ax + gibphase) - curve ay^2

/// Bearings of one direction, rad, each in (0, pi) for points ahead of the station.
struct ThetaPair {
  double x_rad = 0.0;
  double y_rad = 0.0;

  double operator[](Axis axis) const { return axis == Axis::kX ? x_rad : y_rad; }
};

/// Ideal bearings of a point ahead of the station (z > 0), frame L.
ThetaPair ideal_thetas(const Vector3& p_lighthouse);

/// Unit direction (frame L, z > 0) with these ideal bearings.
Vector3 direction_of(const ThetaPair& ideal);

/// Raw theta of `axis` of a station for a point ahead of it (z > 0, frame L; its length does not matter).
double raw_theta(const StationCalibration& station, ModelForm form, Axis axis, const Vector3& p_lighthouse);
/// The same from the direction's ideal bearings.
double raw_theta(const StationCalibration& station, ModelForm form, Axis axis, const ThetaPair& ideal);

/// Ideal bearings from both raw ones, to 1e-9 rad. Empty where no direction ahead of the station has them (impossible
/// angles or an implausible calibration). About 5 evaluations of the model an axis.
std::optional<ThetaPair> ideal_from_raw(const StationCalibration& station, ModelForm form, const ThetaPair& raw);

/// Ideal bearing of one axis where the other one's ideal bearing is known or guessed: an error of the guess reaches the
/// result scaled by tilt and curve, about 1 %.
std::optional<double> ideal_from_raw(const StationCalibration& station, ModelForm form, Axis axis, double raw_rad,
                                     double other_ideal_rad);

}  // namespace pharos::lighthouse
