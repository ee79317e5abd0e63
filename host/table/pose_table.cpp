// SPDX-License-Identifier: Apache-2.0
#include "host/table/pose_table.hpp"

#include <cmath>

#include "host/table/table_reader.hpp"

namespace pharos::host {
namespace {

constexpr double kQuaternionTolerance = 0.01;
constexpr std::size_t kFirstPoseColumn = 1;
constexpr std::size_t kPoseColumns = 7;

bool all_empty(const TableReader& table) {
  for (std::size_t i = 0; i < kPoseColumns; ++i) {
    if (!table.empty(kFirstPoseColumn + i)) return false;
  }
  return true;
}

LighthouseFromBody read_pose(const TableReader& table) {
  const Quaternion q(table.number(1), table.number(2), table.number(3), table.number(4));
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance) {
    table.fail_row("the quaternion qw,qx,qy,qz has length " + std::to_string(q.norm()) + "; it must be 1");
  }
  return {q.normalized().toRotationMatrix(), {table.number(5), table.number(6), table.number(7)}};
}

}  // namespace

std::vector<PoseRow> read_poses(const std::string& path, const std::string& key_column) {
  TableReader table(ByteSource(path), {key_column, "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"});
  std::vector<PoseRow> rows;
  while (table.next()) {
    PoseRow row;
    row.key = table.text(0);
    if (!all_empty(table)) row.T_lighthouse_body = read_pose(table);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace pharos::host
