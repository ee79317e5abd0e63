// SPDX-License-Identifier: Apache-2.0
#include "tools/support/pose_columns.hpp"

#include <array>
#include <utility>

namespace pharos::tools {
namespace {

constexpr std::array kPoseColumns = {"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"};

}  // namespace

std::vector<std::string> with_pose_columns(std::vector<std::string> first, const std::vector<std::string>& last) {
  first.insert(first.end(), kPoseColumns.begin(), kPoseColumns.end());
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

std::vector<std::string> second_solution_columns() {
  std::vector<std::string> columns;
  columns.reserve(kPoseColumns.size() + 1);
  for (const char* column : kPoseColumns) columns.push_back(std::string("alt_") + column);
  columns.emplace_back("delta_chi2");
  return columns;
}

void write_pose(host::RowWriter& rows, const LighthouseFromBody& T_lighthouse_body) {
  const Quaternion q = T_lighthouse_body.quaternion();
  rows.number(q.w()).number(q.x()).number(q.y()).number(q.z());
  const Vector3& t = T_lighthouse_body.t;
  rows.number(t.x()).number(t.y()).number(t.z());
}

host::RowPose row_pose(const LighthousePoseEstimate& estimate, double time_s, std::string series) {
  return {time_s,
          estimate.pose.quaternion(),
          estimate.pose.t,
          estimate.covariance,
          estimate.ambiguous() ? host::PoseGrade::kAmbiguous : host::PoseGrade::kGood,
          std::move(series)};
}

void write_no_pose(host::RowWriter& rows) { rows.none(kPoseColumns.size()); }

void write_second_solution(host::RowWriter& rows, const LighthousePoseEstimate* estimate) {
  if (estimate == nullptr || !estimate->ambiguous()) {
    write_no_pose(rows);
    rows.none();
    return;
  }
  write_pose(rows, estimate->second->pose);
  rows.number(estimate->second->delta_chi2);
}

std::string status_of(const Result<LighthousePoseEstimate, pose::Refusal>& pose) {
  if (!pose) return std::string("refused_") + pose::name_of(pose.error());
  return pose->ambiguous() ? "ambiguous" : "ok";
}

}  // namespace pharos::tools
