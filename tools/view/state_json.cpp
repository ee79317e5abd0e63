// SPDX-License-Identifier: Apache-2.0
#include "tools/view/state_json.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/view/lights.hpp"

namespace pharos::tools {
namespace {

using Json = nlohmann::json;

constexpr double kPosition = 1e6;
constexpr double kSigma = 1e9;

// Few digits: a state is sent thirty times a second.
double rounded(double value, double scale) { return std::round(value * scale) / scale; }

Json json_of(const Vector3& v) {
  return {rounded(v.x(), kPosition), rounded(v.y(), kPosition), rounded(v.z(), kPosition)};
}

Json json_of(const Quaternion& q) {
  return {rounded(q.w(), kPosition), rounded(q.x(), kPosition), rounded(q.y(), kPosition), rounded(q.z(), kPosition)};
}

// Of the position, m^2: xx, xy, xz, yy, yz, zz.
Json position_covariance(const Matrix6& covariance) {
  Json out = Json::array();
  for (int row = 3; row < 6; ++row) {
    for (int column = row; column < 6; ++column) out.push_back(rounded(covariance(row, column), 1e12));
  }
  return out;
}

Json json_of(const Lights& lights) {
  Json out = Json::array();
  for (const Light* light : {&lights.sees_light, &lights.calibrated, &lights.geometry_known, &lights.estimate_good}) {
    out.push_back({name_of(light->level), light->reason});
  }
  return out;
}

void add_number(std::string& text, double value) {
  constexpr int kDigits = 5;
  std::array<char, 32> digits{};  // a ratio is at most 1000: see is_possible
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, kDigits);
  text.append(digits.data(), error == std::errc{} ? end : digits.data());
}

// A list for each sensor that is lit: number, used, x/z, y/z (null where one plane alone hit it). As text at once: of
// 32 targets these are most of a state's values.
void add_sensors(std::string& text, const Sights& sights) {
  text += '[';
  for (std::size_t number = 0; number < sights.sensors.size(); ++number) {
    const auto& sensor = sights.sensors[number];
    if (!sensor) continue;
    if (text.back() != '[') text += ',';
    text += '[' + std::to_string(number) + (sensor->used ? ",true" : ",false");
    for (const std::optional<double>& ratio : {sensor->x_over_z, sensor->y_over_z}) {
      text += ',';
      if (ratio) add_number(text, *ratio);
      if (!ratio) text += "null";
    }
    text += ']';
  }
  text += ']';
}

void add_value(Json& out, const SourceRow& row) {
  if (row.pose) {
    out["p"] = json_of(row.pose->pose->t);
    out["q"] = json_of(row.pose->pose->quaternion());
    out["sigma_m"] = rounded(row.pose->sigma_pos_m, kSigma);
    out["sigma_rad"] = rounded(row.pose->sigma_rot_rad, kSigma);
    out["covariance"] = position_covariance(row.pose->covariance);
    out["residual_rad"] = rounded(row.details.residual_rms_rad, kSigma);
    out["observations"] = row.details.observations;
    out["frames"] = {row.details.parent_frame, row.details.child_frame};
    out["turn"] = row.pose->has_turn;
    out["camera"] = row.pose->of_camera;
    if (row.details.second) {
      out["p2"] = json_of(row.details.second->t);
      out["q2"] = json_of(row.details.second->quaternion());
    }
  }
  if (row.axis) {
    out["axis"] = json_of(row.axis->axis);
    out["pitch_rad"] = rounded(row.axis->pitch_rad, kPosition);
    out["yaw_rad"] = rounded(row.axis->yaw_rad, kPosition);
    out["sigma_rad"] = rounded(row.axis->sigma_rad, kSigma);
  }
  if (row.spin) {
    out["spin"] = json_of(row.spin->rate_rad_s);
    out["sigma_rad_s"] = rounded(row.spin->sigma_rad_s, kSigma);
  }
}

Json fused_json(const FusedReading& fused) {
  const auto level = [](const std::optional<double>& value) { return value ? Json(rounded(*value, kSigma)) : Json(); };
  Json sources = Json::array();
  for (const FusedSource& source : fused.sources) {
    sources.push_back({{"name", source.name},
                       {"state", source.state},
                       {"reason", source.reason},
                       {"age_s", source.age_s < 0.0 ? Json() : Json(rounded(source.age_s, 1e4))},
                       {"nis", rounded(source.normalised_innovation, 1e3)}});
  }
  return {{"mode", fused.mode},
          {"velocity", json_of(fused.velocity_m_s)},
          {"rate", json_of(fused.rate_rad_s)},
          {"protection_m", level(fused.protection_m)},
          {"protection_rad", level(fused.protection_rad)},
          {"sources", std::move(sources)}};
}

Json row_json(const SourceTable& table, const SourceKey& key, const SourceRow& row, const ViewContext& context) {
  Json out = {{"channel", key.channel},
              {"source", key.source},
              {"target", key.target},
              {"station", key.station},
              {"by", row.by},
              {"status", row.status},
              {"flags", row.flags},
              {"refused", row.refused},
              {"lost", row.lost},
              {"version", row.version},
              {"rate", row.arrivals_ns.size()}};
  const bool current = row.current(context.now_ns);
  out["current"] = current;
  out["age_s"] = row.any() ? Json(rounded(row.age_s(context.now_ns), 1e4)) : Json();
  out["lights"] = json_of(lights_of(table, key, row, context.now_ns));
  if (current) add_value(out, row);
  if (row.fused) out["fused"] = fused_json(*row.fused);
  return out;
}

Json daemons_json(const SourceTable& table, std::int64_t now_ns) {
  Json out = Json::array();
  for (const auto& [host, daemon] : table.daemons()) {
    Json sources = Json::array();
    for (const auto& [name, health] : daemon.sources) {
      sources.push_back(
          {{"source", name.first}, {"target", name.second}, {"state", health.state}, {"message", health.message}});
    }
    out.push_back({{"host", host},
                   {"version", daemon.version},
                   {"state", daemon.state},
                   {"message", daemon.message},
                   {"silent", daemon.silent(now_ns)},
                   {"sources", sources}});
  }
  return out;
}

Json events_json(const SourceTable& table) {
  Json out = Json::array();
  for (const SourceEvent& event : table.events()) out.push_back({event.number, event.text});
  return out;
}

// Without the pictures: the page asks for each when it has changed (utime).
Json previews_json(const SourceTable& table, std::int64_t now_ns) {
  Json out = Json::array();
  for (const CameraPreview& preview : table.previews()) {
    out.push_back({{"source", preview.source},
                   {"view", preview.view},
                   {"target", preview.target},
                   {"status", preview.status},
                   {"utime", preview.utime_us},
                   {"age_s", rounded(preview.age_s(now_ns), 1e2)},
                   {"current", preview.current(now_ns)}});
  }
  return out;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// An object's text, to which a last field can be added; close it with '}'.
std::string open_text_of(const Json& object) {
  std::string text = text_of(object);
  text.pop_back();
  return text;
}

std::string rows_text(const SourceTable& table, const ViewContext& context) {
  std::string text = "[";
  for (const auto& [key, row] : table.rows()) {
    if (text.size() > 1) text += ',';
    text += open_text_of(row_json(table, key, row, context));
    const Sights* sights = table.sights_of(key);
    // As long as a value stays current; then the sensors are dark.
    if (sights != nullptr && context.now_ns - sights->arrived_ns < 1'500'000'000) {
      text += ",\"sensors\":";
      add_sensors(text, *sights);
    }
    text += '}';
  }
  return text + ']';
}

}  // namespace

std::string state_json(const SourceTable& table, const ViewContext& context) {
  const LeftOut& left_out = table.left_out();
  Json state = {{"utc_ms", context.utc_ns / 1'000'000},
                {"daemons", daemons_json(table, context.now_ns)},
                {"events", events_json(table)},
                {"previews", previews_json(table, context.now_ns)},
                {"counters",
                 {{"received", table.received()},
                  {"foreign", left_out.foreign},
                  {"impossible", left_out.impossible},
                  {"too_many", left_out.too_many},
                  {"viewers", context.viewers},
                  {"refused_requests", context.refused_requests}}}};
  if (context.replay) {
    const ReplayState& replay = *context.replay;
    state["replay"] = {{"position_s", rounded(replay.position_s, 1e3)},
                       {"duration_s", rounded(replay.duration_s, 1e3)},
                       {"speed", replay.speed},
                       {"playing", replay.playing},
                       {"skipped", replay.skipped}};
  }
  return open_text_of(state) + ",\"rows\":" + rows_text(table, context) + '}';
}

std::string targets_json(const std::map<std::string, Target>& targets) {
  Json out = Json::object();
  for (const auto& [name, target] : targets) {
    Json sensors = Json::array();
    for (const SensorPlacement& placement : target) {
      sensors.push_back({placement.sensor, json_of(placement.position_m)});
    }
    out[name] = std::move(sensors);
  }
  return text_of(out);
}

}  // namespace pharos::tools
