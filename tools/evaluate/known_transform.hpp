// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluate/alignment.hpp"

namespace pharos::evaluate {

/// A transformation that was measured beforehand, from a table of one row, in one of three forms:
/// - `qw,qx,qy,qz,tx_m,ty_m,tz_m`: T_EstimateWorld_TruthWorld;
/// - `phi_x_rad,phi_y_rad,phi_z_rad,x_mm,y_mm,z_mm`: the same as paper 002 prints psi_0 (section 4.3), R(phi) by (5);
/// - `world_qw` ... `world_tz_m,body_qw` ... `body_tz_m`: a row of `pharos evaluate` itself, with the bodies' offset.
/// Throws host::InputError naming file and line: another form, not one row, a quaternion that is not one.
Alignment read_transform(const std::string& path);

}  // namespace pharos::evaluate
