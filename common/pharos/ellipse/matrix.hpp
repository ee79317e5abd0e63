// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace pharos::ellipse {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

}  // namespace pharos::ellipse
