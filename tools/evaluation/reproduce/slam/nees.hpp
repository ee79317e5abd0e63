// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "pharos/geometry/pose.hpp"

namespace pharos::tools {

inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// Normalised estimation error squared of three coordinates, per degree of freedom: 1 where the covariance is true.
inline double nees_of(const Vector3& error, const Matrix3& covariance) {
  return error.dot(covariance.inverse() * error) / 3.0;
}

}  // namespace pharos::tools
