// SPDX-License-Identifier: Apache-2.0
#include "host/table/tum_lines.hpp"

#include <cmath>
#include <utility>

#include "host/support/exact_number.hpp"
#include "host/support/fixed_number.hpp"

namespace pharos::host {

std::string TumLines::line(const std::optional<RowPose>& pose) {
  const auto leave_out = [](std::size_t& count) {
    ++count;
    return std::string();
  };
  if (!pose) return leave_out(left_out_.refused);
  if (!any_series_ && pose->series != series_) return leave_out(left_out_.other_series);
  if (pose->grade == PoseGrade::kAmbiguous) return leave_out(left_out_.ambiguous);
  if (pose->grade == PoseGrade::kNoTurn) return leave_out(left_out_.no_turn);
  if (!std::isfinite(pose->time_s) || !pose->position_m.allFinite() || !pose->orientation.coeffs().allFinite()) {
    return leave_out(left_out_.not_finite);
  }
  if (last_s_ && pose->time_s <= *last_s_) return leave_out(left_out_.not_later);
  any_series_ = false;
  series_ = pose->series;
  last_s_ = pose->time_s;
  ++lines_;
  const Vector3& t = pose->position_m;
  const Quaternion& q = pose->orientation;
  std::string text = fixed_number(pose->time_s);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) text += ' ' + exact_number(value);
  return text + '\n';
}

std::string text_of(const TumLeftOut& left_out) {
  if (left_out.total() == 0) return "";
  std::string reasons;
  for (const auto& [count, words] : {std::pair{left_out.refused, "refused"},
                                     {left_out.ambiguous, "ambiguous"},
                                     {left_out.no_turn, "without a measured turn about their axis"},
                                     {left_out.other_series, "of another station or source"},
                                     {left_out.not_later, "not later than the one before"},
                                     {left_out.not_finite, "not finite"}}) {
    if (count > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + ' ' + words;
  }
  return std::to_string(left_out.total()) + " rows have no TUM line: " + reasons;
}

}  // namespace pharos::host
