// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "host/mounting/mounting.hpp"

namespace pharos::host {

/// Why a matrix is no covariance of a mounting; empty where it is one. Tested after scaling to unit variances, so that
/// radians and metres count alike.
///
/// `zero_allowed`: variances may be zero (a pose that defines a frame); the row must then be zero, too.
std::optional<std::string> covariance_error(const Matrix6& covariance, bool zero_allowed);

/// The same of both poses of a source together, with their cross covariance; each alone must have passed.
std::optional<std::string> joint_covariance_error(const SourceMounting& source);

}  // namespace pharos::host
