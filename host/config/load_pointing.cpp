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

PinholeCamera read_lens(const TomlTable& table, const fs::path& file, const Environment& environment) {
  try {
    return environment.read_camera(file.string()).camera.intrinsics;
  } catch (const InputError& error) {
    table.fail("camera_file", error.what());
  }
}

PointingConfig read_telescope(const TomlTable& table, const fs::path& folder, const Environment& environment,
                              ConfigErrors& errors) {
  PointingConfig telescope;
  pointing::Geodetic& station = telescope.station;
  errors.attempt([&] { telescope.name = read_name(table, "name", table.text("name")); });
  errors.attempt([&] { telescope.target = read_name(table, "target", table.text("target")); });
  errors.attempt([&] {
    telescope.camera_file = read_path(table, "camera_file", folder);
    telescope.camera = read_lens(table, telescope.camera_file, environment);
  });
  errors.attempt([&] { telescope.directory = read_path(table, "directory", folder); });
  errors.attempt([&] {
    telescope.track_file = table.has("track_file") ? read_path(table, "track_file", telescope.directory)
                                                   : telescope.directory / "track.csv";
  });
  errors.attempt([&] { station.latitude_rad = table.number("latitude_deg", {-90.0, 90.0}) * kRadPerDeg; });
  errors.attempt([&] { station.longitude_rad = table.number("longitude_deg", {-180.0, 360.0}) * kRadPerDeg; });
  errors.attempt([&] { station.height_m = table.number_or("height_m", 0.0, {-500.0, 9000.0}); });
  errors.attempt([&] { telescope.law = read_law(table); });
  errors.attempt([&] { telescope.pass_gap_s = table.number_or("pass_gap_s", telescope.pass_gap_s, {0.1, 3600.0}); });
  errors.add_unknown_keys(table);
  return telescope;
}

}  // namespace

std::vector<PointingConfig> read_pointing(const TomlTable& root, const fs::path& folder, const Environment& environment,
                                          ConfigErrors& errors) {
  std::vector<PointingConfig> telescopes;
  std::set<std::string> names, directories;
  for (const TomlTable& table : root.tables("telescope")) {
    telescopes.push_back(read_telescope(table, folder, environment, errors));
    const PointingConfig& telescope = telescopes.back();
    errors.attempt([&] {
      if (telescope.name.empty() || names.insert(telescope.name).second) return;
      table.fail("name", "\"" + telescope.name + "\" is taken by another telescope");
    });
    errors.attempt([&] {
      const std::string directory = telescope.directory.string();
      if (directory.empty() || directories.insert(environment.identity(directory)).second) return;
      table.fail("directory", "\"" + directory + "\" is watched for another telescope");
    });
  }
  return telescopes;
}

}  // namespace pharos::host
