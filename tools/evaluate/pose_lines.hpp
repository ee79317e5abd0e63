// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pharos/geometry/pose.hpp"

namespace pharos::evaluate {

/// A row of any form.
struct RawRow {
  double time_s = 0.0;
  bool refused = false;
  bool ambiguous = false;
  std::string_view flags;
  Quaternion q = Quaternion::Identity();
  Vector3 t = Vector3::Zero();
  std::optional<double> sigma_rot_deg;
  std::optional<double> sigma_pos_mm;
};

/// The pose of a TUM line, `timestamp tx ty tz qx qy qz qw` with blanks between; none for a comment (#). Throws
/// host::InputError, which begins with `where`, for fewer or more numbers and for an invalid number.
std::optional<RawRow> tum_row(std::string_view line, const std::string& where);

/// The same for EuRoC's ground truth: ns since 1970, x, y, z, qw, qx, qy, qz and further columns, which are ignored,
/// separated by commas.
std::optional<RawRow> euroc_row(std::string_view line, const std::string& where);

/// Whether the first line of `head` that is neither blank nor a comment has commas.
bool looks_like_euroc(std::string_view head);

}  // namespace pharos::evaluate
