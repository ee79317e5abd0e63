// SPDX-License-Identifier: Apache-2.0
#include "tools/fuse/fused_tables.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

constexpr double kMaxTime_s = 4e9;  // years of 2096: an integer of nanoseconds holds it

struct NamedTable {
  std::string name;
  std::string path;
};

NamedTable named_table(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  if (equals != std::string::npos) return {argument.substr(0, equals), argument.substr(equals + 1)};
  const std::string file = std::filesystem::path(argument).filename().string();
  return {file.substr(0, file.find('.')), argument};
}

std::string names_of(const host::Mounting& mounting) {
  std::string text;
  for (const host::SourceMounting& source : mounting.sources) text += (text.empty() ? "" : ", ") + source.name;
  return text;
}

const char* words_of(fusion::SettingsError error) {
  switch (error) {
    case fusion::SettingsError::kNoAbsoluteSource:
      return "no source whose feature is known on the target (T_target_feature)";
    case fusion::SettingsError::kMotion:
      return "motion: densities, mean motion (0 to 0.01 rad/s) or moments of inertia that no body has";
    case fusion::SettingsError::kMounting:
      return "a mounting that is no pose";
    case fusion::SettingsError::kBiasModel:
      return "a bias whose covariance or time constant is not positive";
    case fusion::SettingsError::kProbability:
      return "a probability or rate outside of its range";
    default:
      return "no source";
  }
}

ArrivedPose arrived(const host::SourceRow& row, const host::SourceMounting& mounting, std::uint8_t source) {
  ArrivedPose out;
  const double time_s = row.time_s + mounting.time_offset_s;
  out.arrival_s = row.arrival_s.value_or(time_s);
  fusion::Measurement& m = out.measurement;
  m.time_ns = std::llround(time_s * 1e9);
  m.source = source;
  m.pose = {row.pose.R, row.pose.t};
  m.covariance = row.covariance;
  if (!row.has_turn) m.directions = fusion::Directions::without_rotation_about(row.pose.R.col(2));
  if (row.second) m.second = fusion::SensorPose{row.second->R, row.second->t};
  return out;
}

void read_table(const NamedTable& table, const host::SourceMounting& mounting, const FuseChoices& choices,
                const host::SourceTableChoice& table_choice, FusedTables& out) {
  host::SourceTable rows(table.path, mounting.kind, table_choice);
  const auto source = static_cast<std::uint8_t>(out.names.size());
  bool first = true;
  while (const auto row = rows.next()) {
    if (!(std::abs(row->time_s + mounting.time_offset_s) < kMaxTime_s)) {
      throw host::InputError(rows.name() + ": line " + std::to_string(rows.line_number()) +
                             ": a time beyond 4e9 s; give seconds");
    }
    if (first) out.settings.sources.push_back(fused_source(mounting, row->pose, choices));
    first = false;
    out.poses.push_back(arrived(*row, mounting, source));
  }
  if (first) throw host::InputError(rows.name() + ": no row has a pose");
  out.names.push_back(mounting.name);
  out.refused += rows.refused();
}

}  // namespace

FusedTables read_fused_tables(const std::vector<std::string>& tables, const host::Mounting& mounting,
                              const FuseChoices& choices, const host::SourceTableChoice& table_choice) {
  FusedTables out;
  out.settings = fusion_settings(choices);
  for (const std::string& argument : tables) {
    const NamedTable table = named_table(argument);
    const host::SourceMounting* source = mounting.find(table.name);
    if (source == nullptr) {
      throw host::InputError(argument + ": the mounting file has no source '" + table.name + "' (it has " +
                             names_of(mounting) + "); give NAME=TABLE");
    }
    if (std::find(out.names.begin(), out.names.end(), table.name) != out.names.end()) {
      throw host::InputError(argument + ": source '" + table.name + "' is given twice");
    }
    if (out.names.size() == fusion::kMaxSources) {
      throw host::InputError(argument + ": more than " + std::to_string(fusion::kMaxSources) + " sources");
    }
    read_table(table, *source, choices, table_choice, out);
  }
  const fusion::SettingsError error = fusion::check_settings(out.settings);
  if (error != fusion::SettingsError::kNone) throw host::InputError(std::string("fusion: ") + words_of(error));
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const ArrivedPose& a, const ArrivedPose& b) { return a.arrival_s < b.arrival_s; });
  return out;
}

}  // namespace pharos::tools
