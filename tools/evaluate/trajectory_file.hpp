// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/trajectory.hpp"

namespace pharos::evaluate {

/// What of a file is wanted.
struct TrajectoryChoice {
  std::optional<int> station;              // rows of this station only
  double frame_rate_hz = 1.0;              // of tables with a column `frame` instead of a time
  bool keep_ambiguous = false;             // poses that have a rival as good
  std::vector<std::string> without_flags;  // rows with one of these words in `flags` are left out
};

/// What a file held. Rows that are left out keep their place in the counts.
template <class WorldFromBody>
struct TrajectoryFile {
  Trajectory<WorldFromBody> samples;
  std::size_t rows = 0;
  std::size_t refused = 0;    // rows without a pose or with another status than ok and ambiguous
  std::size_t ambiguous = 0;  // left out for being that
  std::size_t flagged = 0;    // left out for a word of without_flags
  double first_s = 0.0;       // times of the first and the last row, left out or not
  double last_s = 0.0;
};

/// Reads a trajectory: TUM (`timestamp tx ty tz qx qy qz qw`, blanks between, # comments), EuRoC's ground truth (a line
/// of comment, then ns, x, y, z, qw, qx, qy, qz and what is passed over, commas between) or a table with a header that
/// has `time_s`, `utime` (us) or `frame`, and qw,qx,qy,qz,tx_m,ty_m,tz_m (tables of pharos, motion capture; other
/// columns are passed over, `station`, `status`, `flags`, `sigma_rot_deg`, `sigma_pos_mm` used). Told by content; .gz;
/// -.
///
/// Throws host::InputError naming file and line: not a table, a number that is none, a quaternion off unit length by
/// more than 1 %, times that do not grow, several stations and none chosen.
template <class WorldFromBody>
TrajectoryFile<WorldFromBody> read_trajectory(const std::string& path, const TrajectoryChoice& choice);

}  // namespace pharos::evaluate
