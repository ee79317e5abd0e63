// SPDX-License-Identifier: Apache-2.0
#include "tools/fuse/range_errors.hpp"

#include <cmath>
#include <utility>

#include "host/files/atomic_file.hpp"
#include "host/table/row_writer.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluate/trajectory_file.hpp"
#include "tools/fuse/truth_errors.hpp"

namespace pharos::tools {
namespace {

constexpr double kBin_m = 1.0;

double angle_rad(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

RangeErrors::RangeErrors(const std::string& truth, std::vector<host::SourceMounting> sources)
    : truth_(evaluate::read_trajectory<evaluate::TruthPose>(truth, evaluate::TrajectoryChoice{}).samples),
      sources_(std::move(sources)) {}

void RangeErrors::add(const fusion::TargetState& state) {
  if (!state.valid) return;
  const fusion::TargetPose& pose = state.kinematics.pose;
  add(sources_.size(), static_cast<double>(state.time_ns) * 1e-9, {pose.R, pose.t}, Vector3::UnitZ(), true);
}

void RangeErrors::add(std::size_t source, const host::SourceRow& row) {
  const host::SourceMounting& mounting = sources_[source];
  const auto pose = host::vehicle_from_target(mounting, row.pose);
  if (!pose) return;
  const Vector3 axis_target = mounting.target_from_feature()->R.col(2);
  add(source, row.time_s + mounting.time_offset_s, *pose, axis_target, row.has_turn);
}

void RangeErrors::add(std::size_t column, double time_s, const host::VehicleFromTarget& pose,
                      const Vector3& axis_target, bool turn) {
  const auto truth = evaluate::pose_at(truth_, time_s, kMaxTruthGap_s);
  if (!truth) return;
  std::vector<Sums>& bin = bins_[static_cast<int>(truth->pose.t.norm() / kBin_m)];
  bin.resize(sources_.size() + 1);
  Sums& sums = bin[column];
  // Without the turn the target's origin is known only where it is on the feature's axis: the feature's place counts.
  const Vector3 p_target = turn ? Vector3::Zero() : Vector3(sources_[column].target_from_feature()->t);
  ++sums.count;
  sums.tilt_rad2 += std::pow(angle_rad(pose.R * axis_target, truth->pose.R * axis_target), 2);
  sums.position_m2 += (pose.R * p_target + pose.t - truth->pose.R * p_target - truth->pose.t).squaredNorm();
  if (!turn) return;
  ++sums.turned;
  sums.rotation_rad2 += rotation_log(pose.R * truth->pose.R.transpose()).squaredNorm();
}

void RangeErrors::write(const std::string& path) const {
  host::AtomicFile file(path);
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv,
                       {"from_m", "to_m", "source", "count", "rms_deg", "rms_tilt_deg", "rms_mm"});
  for (const auto& [bin, columns] : bins_) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Sums& sums = columns[i];
      if (sums.count == 0) continue;
      const auto rms = [](double square, std::size_t count) { return std::sqrt(square / static_cast<double>(count)); };
      rows.number(bin * kBin_m).number((bin + 1) * kBin_m).text(i < sources_.size() ? sources_[i].name : "fused");
      rows.integer(static_cast<std::int64_t>(sums.count));
      if (sums.turned > 0) {
        rows.number(rms(sums.rotation_rad2, sums.turned) * kDegPerRad);
      } else {
        rows.none();
      }
      rows.number(rms(sums.tilt_rad2, sums.count) * kDegPerRad);
      rows.number(rms(sums.position_m2, sums.count) * kMmPerM).end_row();
    }
  }
  rows.flush();
  file.commit();
}

}  // namespace pharos::tools
