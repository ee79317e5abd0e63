// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/docking_target.hpp"

#include "host/support/exact_number.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {
namespace {

constexpr Range kLength_m{1e-4, 100.0};
constexpr Range kPlace_m{-100.0, 100.0};
constexpr Range kSigma_m{1e-9, 100.0};

StatedLength length_of(const TomlTable& table, const std::string& key, Range range) {
  return {table.number(key, range), table.number_or("sigma_" + key, kStatedSigma_m, kSigma_m)};
}

std::optional<StatedLength> length_if_stated(const TomlTable& table, const std::string& key) {
  if (table.has(key)) return length_of(table, key, kLength_m);
  if (table.has("sigma_" + key)) table.fail("sigma_" + key, "is of " + key + ", which is missing; state both");
  return std::nullopt;
}

DockingTarget read_target(const TomlTable& root) {
  DockingTarget file;
  const TomlTable ring = root.table_or_empty("ring"), nozzle = root.table_or_empty("nozzle");
  file.outer_radius = length_if_stated(ring, "outer_radius_m");
  file.inner_radius = length_if_stated(ring, "inner_radius_m");
  file.ring_height = length_if_stated(ring, "height_m");
  file.exit_radius = length_if_stated(nozzle, "exit_radius_m");
  file.nozzle_distance = length_if_stated(nozzle, "distance_m");
  if (file.outer_radius && file.inner_radius && file.inner_radius->value_m >= file.outer_radius->value_m) {
    ring.fail("inner_radius_m", "must be below outer_radius_m");
  }
  for (const TomlTable& table : root.tables("connector")) {
    file.connectors.push_back({length_of(table, "x_m", kPlace_m), length_of(table, "y_m", kPlace_m),
                               length_of(table, "height_m", kPlace_m), table.vector<2>("size_m", kLength_m)});
  }
  root.reject_unknown();
  return file;
}

std::string length_line(const std::string& key, const StatedLength& length) {
  return key + " = " + exact_number(length.value_m) + "\nsigma_" + key + " = " + exact_number(length.sigma_m) + "\n";
}

std::string length_line(const std::string& key, const std::optional<StatedLength>& length) {
  return length ? length_line(key, *length) : "";
}

}  // namespace

DockingTarget read_docking_target(const std::string& path) { return read_target(TomlTable::parse_file(path)); }

DockingTarget parse_docking_target(std::string_view text, const std::string& name) {
  return read_target(TomlTable::parse_text(text, name));
}

std::string docking_target_text(const DockingTarget& file) {
  std::string out = "[ring]\n" + length_line("outer_radius_m", file.outer_radius) +
                    length_line("inner_radius_m", file.inner_radius) + length_line("height_m", file.ring_height);
  out +=
      "\n[nozzle]\n" + length_line("exit_radius_m", file.exit_radius) + length_line("distance_m", file.nozzle_distance);
  for (const StatedConnector& connector : file.connectors) {
    out += "\n[[connector]]\n" + length_line("x_m", connector.x) + length_line("y_m", connector.y) +
           length_line("height_m", connector.height) + "size_m = " + exact_list(connector.size_m) + "\n";
  }
  return out;
}

}  // namespace pharos::host
