// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/trajectory.hpp"

namespace pharos::evaluate {

/// Selection of rows of a file.
struct TrajectoryChoice {
  std::optional<int> station;              // rows of this station only
  double frame_rate_hz = 1.0;              // of tables with a column `frame` instead of a time
  bool keep_ambiguous = false;             // poses with a second solution
  std::vector<std::string> without_flags;  // rows with one of these words in `flags` are left out
};

/// Contents of a file. Rows that are left out are counted.
template <class WorldFromBody>
struct TrajectoryFile {
  Trajectory<WorldFromBody> samples;
  std::size_t rows = 0;
  std::size_t refused = 0;    // rows without a pose or with another status than ok and ambiguous
  std::size_t ambiguous = 0;  // left out as ambiguous
  std::size_t flagged = 0;    // left out for a word of without_flags
  std::size_t repeated = 0;   // beside the rows: the time and the pose of the row before, taken once
  double first_s = 0.0;       // times of the first and the last row, left out or not
  double last_s = 0.0;
};

/// Reads a trajectory: TUM (`timestamp tx ty tz qx qy qz qw`, blanks between, # comments), EuRoC's ground truth (a line
/// of comment, then ns, x, y, z, qw, qx, qy, qz and further columns, which are ignored, separated by commas) or a table
/// with a header that has `time_s`, `utime` (us) or `frame`, and qw,qx,qy,qz,tx_m,ty_m,tz_m (tables of pharos, motion
/// capture; of the others only `station`, `status`, `flags`, `sigma_rot_deg`, `sigma_pos_mm` are used). Recognised by
/// content; .gz; -. Where there is `cov_xx_m2` (`pharos track --sweeps`), rows of all stations are poses in one world;
/// of those of one time the last counts, which holds the light of the others, and they are one row. Of other tables a
/// row with the time and the pose of the one before (within 0.1 mm and 0.1 deg) is taken once and counted.
///
/// Throws host::InputError naming file and line: not a table, an invalid number, a quaternion whose length differs from
/// 1 by more than 1 %, times that do not increase, several stations and none selected.
template <class WorldFromBody>
TrajectoryFile<WorldFromBody> read_trajectory(const std::string& path, const TrajectoryChoice& choice);

}  // namespace pharos::evaluate
