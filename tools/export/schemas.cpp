// SPDX-License-Identifier: Apache-2.0
#include "tools/export/schemas.hpp"

#include <array>
#include <initializer_list>
#include <utility>

namespace pharos::tools {
namespace {

using Field = std::pair<const char*, Json>;

const Json kInteger = {{"type", "integer"}};
const Json kNumber = {{"type", "number"}};
const Json kText = {{"type", "string"}};
const Json kFlag = {{"type", "boolean"}};

Json with_words(Json type, const char* words) {
  type["description"] = words;
  return type;
}
Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json numbers(int count) {
  Json out = list_of(kNumber);
  out["minItems"] = count;
  out["maxItems"] = count;
  return out;
}
Json object(std::initializer_list<Field> fields) {
  Json out = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  for (const auto& [name, type] : fields) {
    out["properties"][name] = type;
    out["required"].push_back(name);
  }
  out["additionalProperties"] = false;
  return out;
}
Json named(Json values) { return {{"type", "object"}, {"additionalProperties", std::move(values)}}; }

const Json kUtime = with_words(kInteger, "time of the measurement, microseconds since 1970-01-01 UTC");
const Json kCounters = named(kInteger);

Json pose_schema() {
  return object(
      {{"utime", kUtime},
       {"utime_sigma_us", kInteger},
       {"latency_us", kInteger},
       {"sequence", kInteger},
       {"source", kText},
       {"station_or_camera", kText},
       {"station", kInteger},
       {"target", kText},
       {"parent_frame", kText},
       {"child_frame", kText},
       {"status", with_words(kText, "ok, ambiguous or refused_REASON: then numbers behind it are 0")},
       {"valid", kFlag},
       {"flags", with_words(kText, "words joined by |")},
       {"position_m", numbers(3)},
       {"orientation_wxyz", numbers(4)},
       {"covariance", with_words(numbers(36), "6x6, row by row, rotation (rad) before translation (m), parent frame")},
       {"sigma_rot_rad", kNumber},
       {"sigma_pos_m", kNumber},
       {"residual_rms_rad", kNumber},
       {"observations", kInteger},
       {"iterations", kInteger},
       {"adop_deg_per_rad", kNumber},
       {"pdop_m_per_rad", kNumber},
       {"has_second", kFlag},
       {"second_position_m", numbers(3)},
       {"second_orientation_wxyz", numbers(4)},
       {"second_delta_chi2", kNumber}});
}

Json pointing_schema() {
  return object({{"utime", kUtime},
                 {"sequence", kInteger},
                 {"source", kText},
                 {"station_or_camera", kText},
                 {"target", kText},
                 {"status", kText},
                 {"valid", kFlag},
                 {"flags", kText},
                 {"from_pass", kFlag},
                 {"images", kInteger},
                 {"axis_station", numbers(3)},
                 {"axis_earth", numbers(3)},
                 {"pitch_rad", kNumber},
                 {"yaw_rad", kNumber},
                 {"earth_pitch_rad", kNumber},
                 {"earth_yaw_rad", kNumber},
                 {"axis_covariance", numbers(9)},
                 {"sigma_axis_rad", kNumber},
                 {"plane_normal_station", numbers(3)},
                 {"sigma_plane_rad", kNumber}});
}

Json spin_schema() {
  return object({{"utime", kUtime},
                 {"sequence", kInteger},
                 {"source", kText},
                 {"station_or_camera", kText},
                 {"target", kText},
                 {"reference_frame", kText},
                 {"status", kText},
                 {"valid", kFlag},
                 {"rate_rad_s", numbers(3)},
                 {"covariance", numbers(9)},
                 {"axis", numbers(3)},
                 {"sigma_rate_rad_s", kNumber},
                 {"sigma_axis_rad", kNumber},
                 {"residual_rms_rad", kNumber},
                 {"attitudes", kInteger},
                 {"span_s", kNumber}});
}

Json status_schema() {
  const Json source = object({{"source", kText},
                              {"target", kText},
                              {"state", kText},
                              {"message", kText},
                              {"device", kText},
                              {"identity", kText},
                              {"data_age_us", kInteger},
                              {"pose_age_us", kInteger},
                              {"pose_rate_hz", kNumber},
                              {"clock_sigma_us", kNumber},
                              {"clock_drift_ppm", kNumber},
                              {"counters", kCounters}});
  return object({{"utime", kUtime},
                 {"sequence", kInteger},
                 {"host", kText},
                 {"version", kText},
                 {"uptime_us", kInteger},
                 {"state", kText},
                 {"message", kText},
                 {"counters", kCounters},
                 {"sources", list_of(source)}});
}

Json bearings_schema() {
  const Json bearing = object({{"sensor", kInteger},
                               {"axis", kInteger},
                               {"raw_theta_rad", kNumber},
                               {"ideal_theta_rad", kNumber},
                               {"width_ticks", kInteger},
                               {"offset_ns", kInteger},
                               {"used", kFlag},
                               {"residual_rad", kNumber}});
  return object({{"utime", kUtime},
                 {"sequence", kInteger},
                 {"source", kText},
                 {"station_or_camera", kText},
                 {"station", kInteger},
                 {"target", kText},
                 {"flags", kText},
                 {"calibrated", kFlag},
                 {"bearings", list_of(bearing)}});
}

Json clock_schema() {
  return object({{"sender", kText},
                 {"recipient", kText},
                 {"session", kInteger},
                 {"sequence", kInteger},
                 {"is_answer", kFlag},
                 {"asked_session", kInteger},
                 {"received_ns", kInteger},
                 {"answered_ns", kInteger}});
}

Json target_state_schema() {
  const Json source = object(
      {{"name", kText}, {"state", kText}, {"reason", kText}, {"age_us", kInteger}, {"normalised_innovation", kNumber}});
  return object(
      {{"utime", kUtime},
       {"sequence", kInteger},
       {"target", kText},
       {"mode", kText},
       {"valid", kFlag},
       {"position_m", numbers(3)},
       {"orientation_wxyz", numbers(4)},
       {"velocity_m_s", numbers(3)},
       {"angular_rate_rad_s", numbers(3)},
       {"covariance", with_words(numbers(144), "12x12, row by row: rotation, position, angular rate, velocity")},
       {"position_protection_available", kFlag},
       {"rotation_protection_available", kFlag},
       {"position_protection_m", kNumber},
       {"rotation_protection_rad", kNumber},
       {"risk_per_hour", kNumber},
       {"sources", list_of(source)},
       {"has_conflict", kFlag},
       {"conflict_without", list_of(kText)},
       {"conflict_position_m", list_of(numbers(3))},
       {"conflict_orientation_wxyz", list_of(numbers(4))}});
}

Json preview_schema() {
  return object({{"utime", kUtime},
                 {"sequence", kInteger},
                 {"source", kText},
                 {"station_or_camera", kText},
                 {"view", kText},
                 {"target", kText},
                 {"status", kText},
                 {"width_px", kInteger},
                 {"height_px", kInteger},
                 {"format", kText},
                 {"size", with_words(kInteger, "bytes of the picture, which is on the topic .../image")}});
}

// Foxglove's published messages, with their fields.
Json time_schema() { return object({{"sec", kInteger}, {"nsec", kInteger}}); }
Json vector_schema() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}}); }
Json quaternion_schema() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}, {"w", kNumber}}); }

Json transform_schema() {
  return object({{"timestamp", time_schema()},
                 {"parent_frame_id", kText},
                 {"child_frame_id", kText},
                 {"translation", vector_schema()},
                 {"rotation", quaternion_schema()}});
}
Json pose_in_frame_schema() {
  return object({{"timestamp", time_schema()},
                 {"frame_id", kText},
                 {"pose", object({{"position", vector_schema()}, {"orientation", quaternion_schema()}})}});
}

Json image_schema() {
  return object({{"timestamp", time_schema()},
                 {"frame_id", kText},
                 {"data", {{"type", "string"}, {"contentEncoding", "base64"}}},
                 {"format", kText}});
}

}  // namespace

const char* schema_name(Topic topic) {
  constexpr std::array<const char*, kTopics> kNames = {
      "pharos.pose",           "foxglove.FrameTransform", "foxglove.PoseInFrame", "pharos.pointing",
      "pharos.spin",           "pharos.status",           "pharos.counters",      "pharos.bearings",
      "pharos.clock_exchange", "pharos.target_state",     "pharos.preview",       "foxglove.CompressedImage"};
  return kNames[static_cast<std::size_t>(topic)];
}

Json schema_of(Topic topic) {
  Json schema;
  switch (topic) {
    case Topic::kPose:
      schema = pose_schema();
      break;
    case Topic::kTransform:
      schema = transform_schema();
      break;
    case Topic::kPoseInFrame:
      schema = pose_in_frame_schema();
      break;
    case Topic::kPointing:
      schema = pointing_schema();
      break;
    case Topic::kSpin:
      schema = spin_schema();
      break;
    case Topic::kStatus:
      schema = status_schema();
      break;
    case Topic::kCounters:
      schema = object({{"utime", kUtime}, {"daemon", kCounters}, {"sources", named(kCounters)}});
      break;
    case Topic::kBearings:
      schema = bearings_schema();
      break;
    case Topic::kClock:
      schema = clock_schema();
      break;
    case Topic::kTargetState:
      schema = target_state_schema();
      break;
    case Topic::kPreview:
      schema = preview_schema();
      break;
    case Topic::kImage:
      schema = image_schema();
      break;
  }
  schema["title"] = schema_name(topic);
  return schema;
}

}  // namespace pharos::tools
