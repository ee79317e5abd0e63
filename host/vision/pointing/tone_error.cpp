// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/tone_error.hpp"

#include <cmath>

#include "host/vision/pointing/panel_measurement.hpp"

namespace pharos::pointing {
namespace {

Vector3 same_way(const Vector3& direction, const Vector3& as) {
  return direction.dot(as) < 0.0 ? Vector3(-direction) : direction;
}

std::optional<AxisEstimate> known_axis(const AxisPlanes& planes) {
  if (planes.size() < 2) return std::nullopt;
  const auto axis = estimate_axis({planes.data(), planes.size()});
  return axis && axis->sigma_rad() < kUnsureSigma_rad ? std::optional(*axis) : std::nullopt;
}

}  // namespace

ToneError tone_error(const PanelMeasurement& panel) {
  ToneError error;
  const auto axis = known_axis(panel.long_planes), moved = known_axis(panel.long_planes_moved);
  if (!axis || !moved) return error;
  const Vector3 moved_axis = same_way(moved->axis, axis->axis);
  const Vector3 change = moved_axis - axis->axis, &up = axis->plane.normal;
  error.shift = change - change.dot(up) * up;
  const auto across = known_axis(panel.short_planes), across_moved = known_axis(panel.short_planes_moved);
  if (!across || !across_moved) return error;
  // Off the right angle by this, and by so much more for what tone curves usually do.
  const double off = axis->axis.dot(across->axis);
  const double slope = moved_axis.dot(same_way(across_moved->axis, across->axis)) - off;
  const double variance =
      across->axis.dot(axis->covariance * across->axis) + axis->axis.dot(across->covariance * axis->axis);
  const double remaining = 1.0 / (1.0 + slope * slope / variance);
  const double told = -remaining * slope * off / variance;
  error.sigma = std::sqrt(told * told + remaining);
  return error;
}

}  // namespace pharos::pointing
