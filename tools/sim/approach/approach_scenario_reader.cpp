// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include "host/toml/strict_toml.hpp"
#include "tools/sim/approach/approach_scenario.hpp"

namespace pharos::sim {
namespace {

using host::Range;
using host::TomlTable;

constexpr Range kDuration_s{1.0, 1e4};
constexpr Range kRange_m{0.05, 1000.0};
constexpr Range kLength_m{-100.0, 100.0};
constexpr Range kRate_hz{0.01, 1000.0};
constexpr Range kAngle_deg{0.0, 180.0};
constexpr Range kSigma_deg{0.0, 90.0};
constexpr Range kSigma_mm{0.0, 1e5};
constexpr Range kTime_s{-1e4, 1e4};
constexpr Range kSpan_s{0.0, 1e4};
constexpr Range kAmount{-1e4, 1e4};
constexpr double kLengthTolerance = 1e-3;

constexpr std::array<std::pair<const char*, ApproachFaultKind>, 8> kFaultWords{
    {{"step", ApproachFaultKind::kStep},
     {"ramp", ApproachFaultKind::kRamp},
     {"freeze", ApproachFaultKind::kFreeze},
     {"wrong_time", ApproachFaultKind::kWrongTime},
     {"scale", ApproachFaultKind::kScale},
     {"mirrored", ApproachFaultKind::kMirrored},
     {"wrong_target", ApproachFaultKind::kWrongTarget},
     {"burst", ApproachFaultKind::kBurst}}};

struct Key {
  const char* name;
  double* value;
  Range range;
};

void read_keys(const TomlTable& table, std::initializer_list<Key> keys) {
  for (const Key& key : keys) *key.value = table.number_or(key.name, *key.value, key.range);
}

ApproachMotion read_motion(const TomlTable& table) {
  ApproachMotion motion;
  const std::string form = table.choice_or("form", "approach", {"approach", "manoeuvre"});
  if (form == "manoeuvre") motion.form = ApproachMotion::Form::kManoeuvre;
  read_keys(table, {{"duration_s", &motion.duration_s, kDuration_s},
                    {"start_m", &motion.start_m, kRange_m},
                    {"end_m", &motion.end_m, kRange_m},
                    {"sway_m", &motion.sway_m, {0.0, 10.0}},
                    {"turn_deg", &motion.turn_deg, {0.0, 60.0}},
                    {"rate_deg_s", &motion.rate_deg_s, {0.0, 60.0}},
                    {"nutation_deg", &motion.nutation_deg, {0.0, 80.0}},
                    {"inertia_ratio", &motion.inertia_ratio, {0.05, 2.0}},
                    {"centre_of_mass_m", &motion.centre_of_mass_m, kLength_m},
                    {"attitude_sway_deg", &motion.attitude_sway_deg, {0.0, 10.0}}});
  if (motion.end_m > motion.start_m) table.fail("end_m", "must not be beyond start_m");
  return motion;
}

template <class PoseType>
void read_pose(const TomlTable& table, const char* position, const char* rotation, PoseType& pose) {
  const auto t = table.vector_or<3>(position, {pose.t.x(), pose.t.y(), pose.t.z()}, kLength_m);
  pose.t = {t[0], t[1], t[2]};
  if (!table.has(rotation)) return;
  const auto q = table.vector<4>(rotation, {-1.001, 1.001});
  const Quaternion quaternion(q[0], q[1], q[2], q[3]);
  if (!(std::abs(quaternion.norm() - 1.0) <= kLengthTolerance)) table.fail(rotation, "must have length 1");
  pose.R = quaternion.normalized().toRotationMatrix();
}

void read_errors(const TomlTable& table, ApproachSource& s) {
  read_keys(table, {{"noise_range_m", &s.noise.range_m, kRange_m},
                    {"noise_power", &s.noise.power, {0.0, 4.0}},
                    {"noise_floor", &s.noise.floor, {0.0, 1.0}},
                    {"tilt_deg", &s.noise.tilt_deg, {1e-4, 90.0}},
                    {"turn_deg", &s.noise.turn_deg, {s.has_turn ? 1e-4 : 0.0, 90.0}},
                    {"lateral_mm", &s.noise.lateral_mm, {1e-3, 1e5}},
                    {"depth_mm", &s.noise.depth_mm, {1e-3, 1e5}},
                    {"bias_deg", &s.bias.rotation_deg, kSigma_deg},
                    {"bias_mm", &s.bias.position_mm, kSigma_mm},
                    {"bias_time_s", &s.bias.time_constant_s, {0.1, 1e5}},
                    {"scale_sigma", &s.scale_sigma, {0.0, 0.5}},
                    {"drift_deg_per_sqrt_s", &s.drift_deg_per_sqrt_s, kSigma_deg},
                    {"drift_mm_per_sqrt_s", &s.drift_mm_per_sqrt_s, kSigma_mm},
                    {"mounting_sigma_deg", &s.mounting_sigma_deg, {1e-6, 90.0}},
                    {"mounting_sigma_mm", &s.mounting_sigma_mm, {1e-6, 1e5}},
                    {"feature_sigma_deg", &s.feature_sigma_deg, {1e-6, 90.0}},
                    {"feature_sigma_mm", &s.feature_sigma_mm, {1e-6, 1e5}},
                    {"time_sigma_s", &s.time_sigma_s, {1e-9, 10.0}}});
}

ApproachSource read_source(const TomlTable& table) {
  ApproachSource s = usual_source(*host::source_kind(table.choice("kind", {"lighthouse", "tof", "ring2", "slam"})));
  s.name = table.text_or("name", s.name);
  if (s.name.empty() || s.name.size() > host::kMaxSourceName ||
      s.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") != std::string::npos) {
    table.fail("name", "must be 1 to 32 of the characters a-z 0-9 _ -");
  }
  s.given = table.boolean_or("given", s.given);
  if (s.given && s.kind == host::SourceKind::kSlam) table.fail("given", "slam has no feature frame of its own to give");
  read_pose(table, "position_m", "rotation_wxyz", s.T_vehicle_sensor);
  read_pose(table, "feature_position_m", "feature_rotation_wxyz", s.T_target_feature);
  if (s.kind != host::SourceKind::kRing2) s.has_turn = table.boolean_or("has_turn", s.has_turn);
  read_keys(table, {{"rate_hz", &s.rate_hz, kRate_hz},
                    {"delay_s", &s.delay_s, {0.0, 10.0}},
                    {"delay_jitter_s", &s.delay_jitter_s, {0.0, 10.0}},
                    {"time_offset_s", &s.time_offset_s, kTime_s},
                    {"min_range_m", &s.min_range_m, {0.0, 1000.0}},
                    {"max_range_m", &s.max_range_m, kRange_m},
                    {"half_field_deg", &s.half_field_deg, kAngle_deg},
                    {"max_incidence_deg", &s.max_incidence_deg, kAngle_deg},
                    {"missed_ratio", &s.missed_ratio, {0.0, 1.0}},
                    {"outages_per_minute", &s.outages_per_minute, {0.0, 600.0}},
                    {"outage_s", &s.outage_s, {0.0, 1e3}}});
  if (table.has("ambiguous_beyond_m")) s.ambiguous_beyond_m = table.number("ambiguous_beyond_m", {0.0, 1e4});
  read_errors(table, s);
  return s;
}

// A number, or [low, high] to draw from.
void read_drawn(const TomlTable& table, const char* key, Range range, double& low, double& high) {
  const std::string low_key = std::string(key) + "_between";
  if (table.has(low_key)) {
    const auto both = table.vector<2>(low_key, range);
    if (both[0] > both[1]) table.fail(low_key, "must be [low, high]");
    if (table.has(key)) table.fail(low_key, std::string("and ") + key + " exclude each other");
    low = both[0];
    high = both[1];
    return;
  }
  low = high = table.number_or(key, low, range);
}

void require_source(const TomlTable& table, const char* key, const ApproachScenario& scenario,
                    const std::string& name) {
  if (scenario.find(name) == nullptr) table.fail(key, "no source has the name \"" + name + "\"");
}

SunPassage read_sun(const TomlTable& table, const ApproachScenario& scenario) {
  SunPassage sun;
  sun.centre_s = table.number("centre_s", kSpan_s);
  read_keys(table, {{"rate_deg_s", &sun.rate_deg_s, {1e-3, 60.0}},
                    {"miss_deg", &sun.miss_deg, kAngle_deg},
                    {"glare_deg", &sun.glare_deg, kAngle_deg},
                    {"blind_deg", &sun.blind_deg, kAngle_deg}});
  if (!(sun.glare_deg > sun.blind_deg)) table.fail("glare_deg", "must be above blind_deg");
  sun.sources = table.texts("sources");
  for (const std::string& name : sun.sources) require_source(table, "sources", scenario, name);
  return sun;
}

ApproachFault read_fault(const TomlTable& table, const ApproachScenario& scenario) {
  ApproachFault fault;
  fault.source = table.text("source");
  require_source(table, "source", scenario, fault.source);
  const std::string kind =
      table.choice("kind", {"step", "ramp", "freeze", "wrong_time", "scale", "mirrored", "wrong_target", "burst"});
  for (const auto& [word, value] : kFaultWords) {
    if (kind == word) fault.kind = value;
  }
  if (!table.has("at_s") && !table.has("at_s_between")) table.fail("at_s", "is missing");
  read_drawn(table, "at_s", kSpan_s, fault.at_low_s, fault.at_high_s);
  read_drawn(table, "amount", kAmount, fault.amount_low, fault.amount_high);
  fault.for_s = table.number_or("for_s", fault.for_s, kSpan_s);
  fault.ramp_s = table.number_or("ramp_s", fault.ramp_s, {1e-3, 1e4});
  const bool free_of_amount = fault.kind == ApproachFaultKind::kFreeze || fault.kind == ApproachFaultKind::kMirrored ||
                              fault.kind == ApproachFaultKind::kWrongTarget;
  const bool has_amount = table.has("amount") || table.has("amount_between");
  if (free_of_amount == has_amount)
    table.fail("amount", free_of_amount ? "has no meaning for this kind" : "is missing");
  return fault;
}

ApproachScenario read_scenario_of(const TomlTable& root) {
  ApproachScenario scenario;
  scenario.motion = read_motion(root.table_or_empty("motion"));
  scenario.truth_step_s = root.number_or("truth_step_s", scenario.truth_step_s, {1e-4, 10.0});
  int given = 0;
  for (const TomlTable& table : root.tables("source")) {
    const ApproachSource source = read_source(table);
    if (scenario.find(source.name) != nullptr) table.fail("name", "source \"" + source.name + "\" comes twice");
    if (scenario.sources.size() == host::kMaxMountedSources) table.fail("name", "more than 16 sources");
    given += source.given ? 1 : 0;
    scenario.sources.push_back(source);
  }
  if (scenario.sources.empty()) root.fail("source", "is missing: a scenario has one [[source]] or more");
  if (given > 1) root.fail("source", "two sources are given; one defines the frames, the others say given = false");
  for (const TomlTable& table : root.tables("sun")) scenario.suns.push_back(read_sun(table, scenario));
  for (const TomlTable& table : root.tables("fault")) scenario.faults.push_back(read_fault(table, scenario));
  root.reject_unknown();
  return scenario;
}

}  // namespace

const char* word_of(ApproachFaultKind kind) { return kFaultWords[static_cast<std::size_t>(kind)].first; }

const ApproachSource* ApproachScenario::find(const std::string& name) const {
  for (const ApproachSource& source : sources) {
    if (source.name == name) return &source;
  }
  return nullptr;
}

ApproachScenario read_approach_scenario(const std::string& path) {
  return read_scenario_of(TomlTable::parse_file(path));
}

ApproachScenario parse_approach_scenario(std::string_view text, const std::string& name) {
  return read_scenario_of(TomlTable::parse_text(text, name));
}

}  // namespace pharos::sim
