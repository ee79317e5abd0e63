// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "host/table/row_pose.hpp"

namespace pharos::host {

/// Rows that have no line in TUM's form, by reason.
struct TumLeftOut {
  std::size_t refused = 0;       // no pose
  std::size_t ambiguous = 0;     // a second solution, for which a line has no place
  std::size_t no_turn = 0;       // an attitude that is not measured
  std::size_t other_series = 0;  // another station's or source's
  std::size_t not_later = 0;     // than the line before
  std::size_t not_finite = 0;

  std::size_t total() const { return refused + ambiguous + no_turn + other_series + not_later + not_finite; }
};

/// Poses as lines `time_s x y z qx qy qz qw` (TUM), of which each holds alone: a good pose, later than the one before,
/// of one series. What is left out is counted.
class TumLines {
 public:
  /// `series`: the one that is written; empty: that of the first good pose.
  explicit TumLines(std::string series = "") : series_(std::move(series)), any_series_(series_.empty()) {}

  /// The line of a row with its end; empty where it is left out. No pose: refused.
  std::string line(const std::optional<RowPose>& pose);

  std::size_t lines() const { return lines_; }
  const TumLeftOut& left_out() const { return left_out_; }

 private:
  std::string series_;
  bool any_series_;  // none was chosen and none was seen
  std::optional<double> last_s_;
  std::size_t lines_ = 0;
  TumLeftOut left_out_;
};

/// "12 rows have no TUM line: 7 refused, 5 ambiguous"; empty where all have one.
std::string text_of(const TumLeftOut& left_out);

}  // namespace pharos::host
