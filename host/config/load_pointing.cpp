// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_pointing.hpp"

#include <set>

#include "host/config/config_parts.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

std::optional<pointing::AttitudeLaw> read_law(const TomlTable& table) {
  const std::string law = table.choice_or("law", "none", {"none", "inertial", "nadir", "spin"});
  if (law == "inertial") return pointing::AttitudeLaw::kInertial;
  if (law == "nadir") return pointing::AttitudeLaw::kNadir;
  if (law == "spin") return pointing::AttitudeLaw::kSpin;
  return std::nullopt;
}

PointingConfig read_telescope(const TomlTable& table, const fs::path& folder, const Environment& environment) {
  PointingConfig telescope;
  telescope.name = read_name(table, "name", table.text("name"));
  telescope.target = read_name(table, "target", table.text("target"));
  telescope.camera_file = read_path(table, "camera_file", folder);
  try {
    telescope.camera = environment.read_camera(telescope.camera_file.string()).camera.intrinsics;
  } catch (const InputError& error) {
    table.fail("camera_file", error.what());
  }
  telescope.directory = read_path(table, "directory", folder);
  telescope.track_file =
      table.has("track_file") ? read_path(table, "track_file", telescope.directory) : telescope.directory / "track.csv";
  telescope.station.latitude_rad = table.number("latitude_deg", {-90.0, 90.0}) * kRadPerDeg;
  telescope.station.longitude_rad = table.number("longitude_deg", {-180.0, 360.0}) * kRadPerDeg;
  telescope.station.height_m = table.number_or("height_m", 0.0, {-500.0, 9000.0});
  telescope.law = read_law(table);
  telescope.pass_gap_s = table.number_or("pass_gap_s", telescope.pass_gap_s, {0.1, 3600.0});
  return telescope;
}

}  // namespace

std::vector<PointingConfig> read_pointing(const TomlTable& root, const fs::path& folder,
                                          const Environment& environment) {
  std::vector<PointingConfig> telescopes;
  std::set<std::string> names, directories;
  for (const TomlTable& table : root.tables("telescope")) {
    telescopes.push_back(read_telescope(table, folder, environment));
    const PointingConfig& telescope = telescopes.back();
    if (!names.insert(telescope.name).second) {
      table.fail("name", "\"" + telescope.name + "\" is taken by another telescope");
    }
    if (!directories.insert(environment.identity(telescope.directory.string())).second) {
      table.fail("directory", "\"" + telescope.directory.string() + "\" is watched for another telescope");
    }
  }
  return telescopes;
}

}  // namespace pharos::host
