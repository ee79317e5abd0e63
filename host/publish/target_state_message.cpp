// SPDX-License-Identifier: Apache-2.0
#include "host/publish/target_state_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/support/time_units.hpp"
#include "pharos/fusion/words.hpp"

namespace pharos::host {
namespace {

void fill_pose(const fusion::TargetPose& pose, double (&position)[3], double (&wxyz)[4]) {
  const Quaternion q = pose.quaternion();
  std::copy_n(pose.t.data(), 3, position);
  const std::array<double, 4> values = {q.w(), q.x(), q.y(), q.z()};
  std::copy(values.begin(), values.end(), wxyz);
}

bool is_finite(const fusion::TargetState& state) {
  const fusion::Kinematics& k = state.kinematics;
  return k.pose.is_finite() && k.rate_rad_s.allFinite() && k.velocity_m_s.allFinite() && state.covariance.allFinite();
}

void fill_state(const fusion::TargetState& state, target_state_t& message) {
  const fusion::Kinematics& k = state.kinematics;
  fill_pose(k.pose, message.position_m, message.orientation_wxyz);
  std::copy_n(k.velocity_m_s.data(), 3, message.velocity_m_s);
  std::copy_n(k.rate_rad_s.data(), 3, message.angular_rate_rad_s);
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 12; ++column) message.covariance[12 * row + column] = state.covariance(row, column);
  }
  const fusion::ProtectionLevel& level = state.protection;
  message.position_protection_available = level.position_available ? 1 : 0;
  message.rotation_protection_available = level.rotation_available ? 1 : 0;
  message.position_protection_m = level.position_m;
  message.rotation_protection_rad = level.rotation_rad;
}

void fill_conflict(const fusion::TargetState& state, const std::vector<std::string>& names, target_state_t& message) {
  if (state.mode != fusion::Mode::kConflict || !state.conflict[0].valid || !state.conflict[1].valid) return;
  message.has_conflict = 1;
  for (std::size_t side = 0; side < 2; ++side) {
    const fusion::ConflictSide& from = state.conflict[side];
    if (from.without < names.size()) message.conflict_without[side] = names[from.without];
    fill_pose(from.pose, message.conflict_position_m[side], message.conflict_orientation_wxyz[side]);
  }
}

}  // namespace

const char* channel_of(const TargetStateReport&) { return "TARGET_STATE"; }

bool is_finite(const TargetStateReport& report) {
  const fusion::ProtectionLevel& level = report.state.protection;
  return is_finite(report.state) && std::isfinite(level.position_m) && std::isfinite(level.rotation_rad);
}

target_state_t message_of(const TargetStateReport& report) {
  return message_of(report.state, {report.utc_ns, report.sequence, report.target, report.names, report.risk_per_hour});
}

target_state_t message_of(const fusion::TargetState& state, const TargetStateHeader& header) {
  target_state_t message{};
  message.utime = header.utc_ns / kNsPerUs;
  message.sequence = header.sequence;
  message.target = header.target;
  message.mode = word_of(state.mode);
  message.risk_per_hour = header.risk_per_hour;
  message.valid = state.valid && is_finite(state) ? 1 : 0;
  for (std::size_t s = 0; s < state.sources.size() && s < header.sources.size(); ++s) {
    const fusion::SourceReport& from = state.sources[s];
    fused_source_t source{};
    source.name = header.sources[s];
    source.state = word_of(from.state);
    if (from.state == fusion::SourceState::kExcluded) source.reason = word_of(from.reason);
    source.age_us = from.heard ? static_cast<std::int64_t>(from.age_s * 1e6) : -1;
    source.normalised_innovation = from.normalised_innovation;
    message.sources.push_back(source);
  }
  message.source_count = static_cast<std::int32_t>(message.sources.size());
  if (message.valid == 0) return message;
  fill_state(state, message);
  fill_conflict(state, header.sources, message);
  return message;
}

}  // namespace pharos::host
