// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pharos {

// Fixed-size Eigen types only: none of them uses the heap.
using Vector2 = Eigen::Matrix<double, 2, 1>;
using Vector3 = Eigen::Matrix<double, 3, 1>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix<double, 3, 3>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
/// Stored x, y, z, w by Eigen; printed and sent w, x, y, z with w >= 0.
using Quaternion = Eigen::Quaternion<double>;

}  // namespace pharos
