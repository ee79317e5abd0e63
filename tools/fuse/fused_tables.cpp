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

void read_table(const NamedTable& table, const host::SourceMounting& mounting,
                const host::SourceTableChoice& table_choice, FusedTables& out) {
  host::SourceTable rows(table.path, mounting.kind, table_choice);
  const std::size_t before = out.poses.size();
  while (const auto row = rows.next()) {
    const double time_s = row->time_s + mounting.time_offset_s;
    if (!(std::abs(time_s) < kMaxTime_s)) {
      throw host::InputError(rows.name() + ": line " + std::to_string(rows.line_number()) +
                             ": a time beyond 4e9 s; give seconds");
    }
    out.poses.push_back({row->arrival_s.value_or(time_s), out.sources.size(), *row});
  }
  if (out.poses.size() == before) throw host::InputError(rows.name() + ": no row has a pose");
  out.sources.push_back(mounting);
  out.refused += rows.refused();
}

}  // namespace

FusedTables read_fused_tables(const std::vector<std::string>& tables, const host::Mounting& mounting,
                              const host::SourceTableChoice& table_choice) {
  FusedTables out;
  for (const std::string& argument : tables) {
    const NamedTable table = named_table(argument);
    const host::SourceMounting* source = mounting.find(table.name);
    if (source == nullptr) {
      throw host::InputError(argument + ": the mounting file has no source '" + table.name + "' (it has " +
                             names_of(mounting) + "); give NAME=TABLE");
    }
    const bool twice = std::any_of(out.sources.begin(), out.sources.end(),
                                   [&](const host::SourceMounting& other) { return other.name == table.name; });
    if (twice) throw host::InputError(argument + ": source '" + table.name + "' is given twice");
    read_table(table, *source, table_choice, out);
  }
  std::stable_sort(out.poses.begin(), out.poses.end(),
                   [](const ArrivedPose& a, const ArrivedPose& b) { return a.arrival_s < b.arrival_s; });
  return out;
}

}  // namespace pharos::tools
