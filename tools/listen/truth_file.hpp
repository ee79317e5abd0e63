// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::tools {

/// The true poses that a simulator writes while it plays: `utime` (microseconds UTC) or `time_s` (seconds UTC), then
/// `qw,qx,qy,qz,tx_m,ty_m,tz_m`, with a column `station` where there are two. Other columns are ignored.
///
/// The file may still grow: rows added since the last call are read when needed.
class TruthFile {
 public:
  /// Throws host::InputError when the file cannot be opened.
  explicit TruthFile(const std::string& path);

  /// True pose at `utc_us`, interpolated linearly and by slerp; empty outside the rows available (yet).
  /// Throws host::InputError naming file and line for a row that cannot be read.
  std::optional<LighthouseFromBody> at(int station, std::int64_t utc_us);

 private:
  static constexpr std::size_t kStations = 2;
  struct Row {
    std::int64_t utc_us = 0;
    Quaternion orientation = Quaternion::Identity();
    Vector3 position_m = Vector3::Zero();
  };

  void read_new_rows();
  void read_header(const std::string& line);
  void read_row(const std::string& line);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::ifstream in_;
  std::string unfinished_;  // a line whose end was not written yet
  std::size_t line_ = 0;
  bool has_header_ = false;
  bool time_in_seconds_ = false;
  std::size_t time_column_ = 0;
  std::optional<std::size_t> station_column_;
  std::array<std::size_t, 7> pose_columns_{};
  std::array<std::vector<Row>, kStations> rows_;
};

}  // namespace pharos::tools
