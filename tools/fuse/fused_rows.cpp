// SPDX-License-Identifier: Apache-2.0
#include "tools/fuse/fused_rows.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "pharos/base/units.hpp"
#include "pharos/fusion/words.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kStateFields = 15;  // pose, rates, sigmas

void append(std::string& words, const std::string& word) { words += (words.empty() ? "" : "|") + word; }

void write_state(const fusion::TargetState& state, host::RowWriter& rows) {
  const fusion::Kinematics& k = state.kinematics;
  const Quaternion q = k.pose.quaternion();
  for (const double v : {q.w(), q.x(), q.y(), q.z(), k.pose.t.x(), k.pose.t.y(), k.pose.t.z()}) rows.number(v);
  for (int axis = 0; axis < 3; ++axis) rows.number(k.velocity_m_s[axis]);
  for (int axis = 0; axis < 3; ++axis) rows.number(k.rate_rad_s[axis]);
  rows.number(std::sqrt(state.covariance.block<3, 3>(0, 0).trace()) * kDegPerRad);
  rows.number(std::sqrt(state.covariance.block<3, 3>(3, 3).trace()) * kMmPerM);
}

}  // namespace

std::vector<std::string> fused_columns(bool truth) {
  std::vector<std::string> columns = {"time_s",
                                      "qw",
                                      "qx",
                                      "qy",
                                      "qz",
                                      "tx_m",
                                      "ty_m",
                                      "tz_m",
                                      "vx_m_s",
                                      "vy_m_s",
                                      "vz_m_s",
                                      "wx_rad_s",
                                      "wy_rad_s",
                                      "wz_rad_s",
                                      "sigma_rot_deg",
                                      "sigma_pos_mm",
                                      "protection_rot_deg",
                                      "protection_pos_mm",
                                      "mode",
                                      "sources",
                                      "excluded"};
  if (truth) {
    for (const char* column : {"error_rot_deg", "error_pos_mm", "nees", "outside"}) columns.emplace_back(column);
  }
  return columns;
}

void write_fused_row(const fusion::TargetState& state, const std::vector<std::string>& names,
                     const std::optional<StateError>& error, bool truth, host::RowWriter& rows) {
  rows.number(static_cast<double>(state.time_ns) * 1e-9);
  if (state.valid) {
    write_state(state, rows);
  } else {
    rows.none(kStateFields);
  }
  const fusion::ProtectionLevel& level = state.protection;
  rows.number(level.rotation_available ? std::optional(level.rotation_rad * kDegPerRad) : std::nullopt);
  rows.number(level.position_available ? std::optional(level.position_m * kMmPerM) : std::nullopt);
  std::string used;
  std::string excluded;
  for (std::size_t s = 0; s < names.size() && s < state.sources.size(); ++s) {
    const fusion::SourceReport& source = state.sources[s];
    if (source.state == fusion::SourceState::kUsed) append(used, names[s]);
    if (source.state == fusion::SourceState::kExcluded) append(excluded, names[s] + ":" + word_of(source.reason));
    if (source.state == fusion::SourceState::kConflict) append(excluded, names[s] + ":conflict");
  }
  rows.text(word_of(state.mode)).text(used).text(excluded);
  if (truth && error) {
    rows.number(error->rotation_rad * kDegPerRad).number(error->position_m * kMmPerM).number(error->nees);
    rows.integer(error->outside ? 1 : 0);
  } else if (truth) {
    rows.none(4);
  }
  rows.end_row();
}

std::string tum_line(const fusion::TargetState& state) {
  const Quaternion q = state.kinematics.pose.quaternion();
  const Vector3& t = state.kinematics.pose.t;
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), "%.9f %.9g %.9g %.9g %.12g %.12g %.12g %.12g\n",
                static_cast<double>(state.time_ns) * 1e-9, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  return text.data();
}

}  // namespace pharos::tools
