// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/received_state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "pharos/base/units.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::tools {
namespace {

constexpr int kStates = 12;

// Name and state come from the network; a source more than any daemon fuses is not shown.
constexpr std::size_t kMaxSources = 16;
constexpr std::size_t kMaxText = 40;

Vector3 vector_of(const double (&values)[3]) { return {values[0], values[1], values[2]}; }

FusedReading reading_of(const target_state_t& message) {
  FusedReading out;
  out.mode = message.mode.substr(0, kMaxText);
  for (const fused_source_t& source : message.sources) {
    if (out.sources.size() == kMaxSources) break;
    out.sources.push_back(
        {source.name.substr(0, kMaxText), source.state.substr(0, kMaxText), source.reason.substr(0, kMaxText),
         source.age_us < 0 ? -1.0 : static_cast<double>(source.age_us) * 1e-6, source.normalised_innovation});
  }
  if (message.valid == 0) return out;
  out.velocity_m_s = vector_of(message.velocity_m_s);
  out.rate_rad_s = vector_of(message.angular_rate_rad_s);
  if (message.position_protection_available != 0) out.protection_m = message.position_protection_m;
  if (message.rotation_protection_available != 0) out.protection_rad = message.rotation_protection_rad;
  return out;
}

std::string flags_of(const FusedReading& fused) {
  std::string flags;
  for (const FusedSource& source : fused.sources) {
    if (source.state != "excluded" && source.state != "conflict") continue;
    flags += (flags.empty() ? "" : "|") + source.name + ':' + source.state +
             (source.reason.empty() ? "" : ':' + source.reason);
  }
  return flags;
}

}  // namespace

ReceivedPose received_state(const std::string& channel, const target_state_t& message, std::int64_t utc_ns) {
  ReceivedPose pose;
  pose.utime_us = message.utime;
  pose.sequence = message.sequence;
  pose.channel = channel;
  pose.source = kFusionSource;
  pose.target = message.target;
  pose.station_id = kFusionSource;
  pose.status = message.mode;
  pose.fused = reading_of(message);
  pose.flags = flags_of(*pose.fused);
  pose.age_s = static_cast<double>(utc_ns) * 1e-9 - static_cast<double>(message.utime) * 1e-6;
  if (message.valid == 0) return pose;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      pose.covariance(row, column) = message.covariance[kStates * row + column];
    }
  }
  pose.sigma_rot_rad = std::sqrt(pose.covariance.topLeftCorner<3, 3>().trace());
  pose.sigma_pos_m = std::sqrt(pose.covariance.bottomRightCorner<3, 3>().trace());
  const double* q = message.orientation_wxyz;
  pose.pose = LighthouseFromBody{Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(),
                                 vector_of(message.position_m)};
  return pose;
}

std::string fused_text(const FusedReading& fused) {
  std::string out = "protected to ";
  out += fused.protection_m ? fmt::format("{:.1f} mm", *fused.protection_m * kMmPerM) : "- mm";
  out += fused.protection_rad ? fmt::format(" {:.2f} deg", *fused.protection_rad * kDegPerRad) : " - deg";
  for (std::size_t s = 0; s < fused.sources.size(); ++s) {
    const FusedSource& source = fused.sources[s];
    out += (s == 0 ? "  " : ", ") + source.name + ' ' + source.state;
    if (!source.reason.empty()) out += " (" + source.reason + ')';
  }
  return out;
}

std::string state_json(const target_state_t& message) {
  using Json = nlohmann::ordered_json;
  const bool valid = message.valid != 0;
  Json out = {{"utime", message.utime},
              {"sequence", message.sequence},
              {"target", message.target},
              {"mode", message.mode},
              {"risk_per_hour", message.risk_per_hour}};
  const auto add = [&out](const char* name, bool known, const Json& value) { out[name] = known ? value : Json(); };
  add("position_m", valid, Json(message.position_m));
  add("orientation_wxyz", valid, Json(message.orientation_wxyz));
  add("velocity_m_s", valid, Json(message.velocity_m_s));
  add("angular_rate_rad_s", valid, Json(message.angular_rate_rad_s));
  add("covariance", valid, Json(message.covariance));
  add("protection_pos_mm", valid && message.position_protection_available != 0,
      message.position_protection_m * kMmPerM);
  add("protection_rot_deg", valid && message.rotation_protection_available != 0,
      message.rotation_protection_rad * kDegPerRad);
  Json sources = Json::array();
  for (const fused_source_t& source : message.sources) {
    Json one = {{"name", source.name}, {"state", source.state}, {"reason", source.reason}};
    one["age_ms"] = source.age_us < 0 ? Json() : Json(static_cast<double>(source.age_us) * 1e-3);
    one["normalised_innovation"] = source.normalised_innovation;
    sources.push_back(one);
  }
  out["sources"] = sources;
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pharos::tools
