// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::host {

/// One row of a pose table. A row whose pose fields are all empty (a refusal in our own tables) has no pose.
struct PoseRow {
  std::string key;  // the first column as written: a pose's name, a time, a problem's number
  std::optional<LighthouseFromBody> T_lighthouse_body;
};

/// Reads `KEY,qw,qx,qy,qz,tx_m,ty_m,tz_m` (other columns are ignored), KEY being `pose`, `time_s` or `problem`.
/// Quaternions must have length 1 within 1 % and are normalised. Throws InputError naming file, line and column.
std::vector<PoseRow> read_poses(const std::string& path, const std::string& key_column);

}  // namespace pharos::host
