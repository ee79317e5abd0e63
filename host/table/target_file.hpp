// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/geometry/target.hpp"

namespace pharos::host {

/// A target from its file, checked.
struct TargetFile {
  Target target;
  /// Where `shape.coplanar` is true, tell the user: single cycles may then fit two poses.
  TargetShape shape;
};

/// Reads `sensor,x_m,y_m,z_m[,nx,ny,nz]`: a photodiode's number (0..31), its position in the body frame and, where
/// known, its outward normal (length 1 within 5 %, or empty or 0,0,0 for unknown), in any order of rows.
///
/// Coordinates beyond 12 m are refused: they are probably in millimetres. Throws InputError naming file and line for
/// anything that check_target refuses (a sensor twice, two in one place, all on one line, fewer than three) or that is
/// not a table.
TargetFile read_target(const std::string& path);

}  // namespace pharos::host
