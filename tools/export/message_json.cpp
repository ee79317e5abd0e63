// SPDX-License-Identifier: Apache-2.0
#include "tools/export/message_json.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::tools {
namespace {

Json named_counters(const std::vector<counter_t>& counters) {
  Json out = Json::object();
  for (const counter_t& counter : counters) out[counter.name] = counter.value;
  return out;
}

Json json_of_source(const source_status_t& m) {
  return {{"source", m.source},
          {"target", m.target},
          {"state", m.state},
          {"message", m.message},
          {"device", m.device},
          {"identity", m.identity},
          {"data_age_us", m.data_age_us},
          {"pose_age_us", m.pose_age_us},
          {"pose_rate_hz", m.pose_rate_hz},
          {"clock_sigma_us", m.clock_sigma_us},
          {"clock_drift_ppm", m.clock_drift_ppm},
          {"counters", named_counters(m.counters)}};
}

Json json_of_bearing(const bearing_t& m) {
  return {{"sensor", m.sensor},
          {"axis", m.axis},
          {"raw_theta_rad", m.raw_theta_rad},
          {"ideal_theta_rad", m.ideal_theta_rad},
          {"width_ticks", m.width_ticks},
          {"offset_ns", m.offset_ns},
          {"used", m.used != 0},
          {"residual_rad", m.residual_rad}};
}

}  // namespace

Json json_of(const pose_t& m) {
  return {{"utime", m.utime},
          {"utime_sigma_us", m.utime_sigma_us},
          {"latency_us", m.latency_us},
          {"sequence", m.sequence},
          {"source", m.source},
          {"station_or_camera", m.station_or_camera},
          {"station", m.station},
          {"target", m.target},
          {"parent_frame", m.parent_frame},
          {"child_frame", m.child_frame},
          {"status", m.status},
          {"valid", m.valid != 0},
          {"flags", m.flags},
          {"position_m", m.position_m},
          {"orientation_wxyz", m.orientation_wxyz},
          {"covariance", m.covariance},
          {"sigma_rot_rad", m.sigma_rot_rad},
          {"sigma_pos_m", m.sigma_pos_m},
          {"residual_rms_rad", m.residual_rms_rad},
          {"observations", m.observations},
          {"iterations", m.iterations},
          {"adop_deg_per_rad", m.adop_deg_per_rad},
          {"pdop_m_per_rad", m.pdop_m_per_rad},
          {"has_second", m.has_second != 0},
          {"second_position_m", m.second_position_m},
          {"second_orientation_wxyz", m.second_orientation_wxyz},
          {"second_delta_chi2", m.second_delta_chi2}};
}

Json json_of(const pointing_t& m) {
  return {{"utime", m.utime},
          {"sequence", m.sequence},
          {"source", m.source},
          {"station_or_camera", m.station_or_camera},
          {"target", m.target},
          {"status", m.status},
          {"valid", m.valid != 0},
          {"flags", m.flags},
          {"from_pass", m.from_pass != 0},
          {"images", m.images},
          {"axis_station", m.axis_station},
          {"axis_earth", m.axis_earth},
          {"pitch_rad", m.pitch_rad},
          {"yaw_rad", m.yaw_rad},
          {"earth_pitch_rad", m.earth_pitch_rad},
          {"earth_yaw_rad", m.earth_yaw_rad},
          {"axis_covariance", m.axis_covariance},
          {"sigma_axis_rad", m.sigma_axis_rad},
          {"plane_normal_station", m.plane_normal_station},
          {"sigma_plane_rad", m.sigma_plane_rad}};
}

Json json_of(const spin_t& m) {
  return {{"utime", m.utime},
          {"sequence", m.sequence},
          {"source", m.source},
          {"station_or_camera", m.station_or_camera},
          {"target", m.target},
          {"reference_frame", m.reference_frame},
          {"status", m.status},
          {"valid", m.valid != 0},
          {"rate_rad_s", m.rate_rad_s},
          {"covariance", m.covariance},
          {"axis", m.axis},
          {"sigma_rate_rad_s", m.sigma_rate_rad_s},
          {"sigma_axis_rad", m.sigma_axis_rad},
          {"residual_rms_rad", m.residual_rms_rad},
          {"attitudes", m.attitudes},
          {"span_s", m.span_s}};
}

Json json_of(const status_t& m) {
  Json sources = Json::array();
  for (const source_status_t& source : m.sources) sources.push_back(json_of_source(source));
  return {{"utime", m.utime},         {"sequence", m.sequence},
          {"host", m.host},           {"version", m.version},
          {"uptime_us", m.uptime_us}, {"state", m.state},
          {"message", m.message},     {"counters", named_counters(m.counters)},
          {"sources", sources}};
}

Json json_of(const bearings_t& m) {
  Json bearings = Json::array();
  for (const bearing_t& bearing : m.bearings) bearings.push_back(json_of_bearing(bearing));
  return {{"utime", m.utime},     {"sequence", m.sequence},
          {"source", m.source},   {"station_or_camera", m.station_or_camera},
          {"station", m.station}, {"target", m.target},
          {"flags", m.flags},     {"calibrated", m.calibrated != 0},
          {"bearings", bearings}};
}

Json json_of(const clock_exchange_t& m) {
  return {{"sender", m.sender},           {"recipient", m.recipient},      {"session", m.session},
          {"sequence", m.sequence},       {"is_answer", m.is_answer != 0}, {"asked_session", m.asked_session},
          {"received_ns", m.received_ns}, {"answered_ns", m.answered_ns}};
}

Json json_of(const target_state_t& m) {
  Json sources = Json::array();
  for (const fused_source_t& source : m.sources) {
    sources.push_back({{"name", source.name},
                       {"state", source.state},
                       {"reason", source.reason},
                       {"age_us", source.age_us},
                       {"normalised_innovation", source.normalised_innovation}});
  }
  return {{"utime", m.utime},
          {"sequence", m.sequence},
          {"target", m.target},
          {"mode", m.mode},
          {"valid", m.valid != 0},
          {"position_m", m.position_m},
          {"orientation_wxyz", m.orientation_wxyz},
          {"velocity_m_s", m.velocity_m_s},
          {"angular_rate_rad_s", m.angular_rate_rad_s},
          {"covariance", m.covariance},
          {"position_protection_available", m.position_protection_available != 0},
          {"rotation_protection_available", m.rotation_protection_available != 0},
          {"position_protection_m", m.position_protection_m},
          {"rotation_protection_rad", m.rotation_protection_rad},
          {"risk_per_hour", m.risk_per_hour},
          {"sources", std::move(sources)},
          {"has_conflict", m.has_conflict != 0},
          {"conflict_without", m.conflict_without},
          {"conflict_position_m", m.conflict_position_m},
          {"conflict_orientation_wxyz", m.conflict_orientation_wxyz}};
}

Json json_of(const preview_t& m) {
  return {{"utime", m.utime},         {"sequence", m.sequence},
          {"source", m.source},       {"station_or_camera", m.station_or_camera},
          {"view", m.view},           {"target", m.target},
          {"status", m.status},       {"width_px", m.width_px},
          {"height_px", m.height_px}, {"format", m.format},
          {"size", m.data.size()}};
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8U | (k < count ? bytes[at + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += k <= count ? kDigits[bits >> (18U - 6U * k) & 63U] : '=';
  }
  return out;
}

Json counters_of(const status_t& m) {
  Json sources = Json::object();
  for (const source_status_t& source : m.sources) sources[source.source] = named_counters(source.counters);
  return {{"utime", m.utime}, {"daemon", named_counters(m.counters)}, {"sources", sources}};
}

bool all_finite(const Json& value) {
  if (value.is_number_float()) return std::isfinite(value.get<double>());
  return !value.is_structured() || std::all_of(value.begin(), value.end(), all_finite);
}

std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace pharos::tools
