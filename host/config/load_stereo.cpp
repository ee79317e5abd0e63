// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_stereo.hpp"

#include <algorithm>
#include <set>

#include "host/config/config_parts.hpp"
#include "host/config/load_device.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr double kMsPerSecond = 1e3;
constexpr std::array<const char*, 2> kSides{"left", "right"};

void read_systems(const TomlTable& table, StereoConfig& stereo) {
  const std::vector<std::string> systems = table.texts("systems");
  if (systems.empty()) table.fail("systems", "is missing; give [\"ring2\"], [\"slam\"] or [\"ring2\", \"slam\"]");
  for (const std::string& system : systems) {
    const bool again = (system == "ring2" && stereo.ring2) || (system == "slam" && stereo.slam);
    if (again) table.fail("systems", "names \"" + system + "\" twice");
    if (system == "ring2") {
      stereo.ring2 = true;
    } else if (system == "slam") {
      stereo.slam.emplace();
    } else {
      table.fail("systems", "\"" + system + "\" is none; there are ring2 and slam");
    }
  }
}

LowLight read_enhance(const TomlTable& table) {
  const std::string word = table.choice_or("enhance", "off", {"off", "bm3d", "fast", "none"});
  if (word == "bm3d") return LowLight::kBm3d;
  if (word == "fast") return LowLight::kFast;
  if (word == "none") return LowLight::kNotDenoised;
  return LowLight::kOff;
}

void read_slam(const TomlTable& table, const fs::path& folder, SlamConfig& slam, ConfigErrors& errors) {
  slam::SlamSettings& settings = slam.settings;
  errors.attempt([&] {
    settings.scene = slam::scene_named(table.choice_or("scene", "auto", {"auto", "target", "static"}));
  });
  errors.attempt(
      [&] { settings.features = static_cast<int>(table.integer_or("features", settings.features, 100, 10'000)); });
  errors.attempt([&] {
    settings.max_keyframes = static_cast<std::size_t>(
        table.has("max_keyframes") ? table.integer("max_keyframes", 5, 100'000) : std::int64_t{0});
  });
  errors.attempt([&] { settings.close_loops = table.boolean_or("close_loops", settings.close_loops); });
  errors.attempt([&] {
    if (table.has("vocabulary")) settings.vocabulary = read_path(table, "vocabulary", folder).string();
  });
  errors.attempt([&] { slam.enhance = read_enhance(table); });
}

void read_rig(const TomlTable& table, const fs::path& folder, const Environment& environment, StereoConfig& stereo) {
  stereo.rig_file = read_path(table, "rig_file", folder);
  try {
    stereo.rig = environment.read_rig(stereo.rig_file.string());
    if (stereo.ring2) environment.check_ring2(stereo.rig);
    if (stereo.slam) environment.check_slam(stereo.rig, stereo.rig_file.string());
  } catch (const InputError& error) {
    table.fail("rig_file", error.what());
  }
}

void check_vocabulary(const TomlTable& table, const Environment& environment, const SlamConfig& slam) {
  try {
    environment.check_vocabulary(slam.settings.vocabulary);
  } catch (const InputError& error) {
    table.fail("vocabulary", error.what());
  }
}

void read_frames(const TomlTable& table, const fs::path& folder, const Environment& environment, StereoConfig& stereo) {
  stereo.frames = read_path(table, "frames", folder);
  try {
    stereo.replays_camera = environment.check_pairs(stereo.frames, stereo.rig, stereo.name);
  } catch (const InputError& error) {
    table.fail("frames", error.what());
  }
}

void read_window(const TomlTable& table, StereoConfig& stereo) {
  stereo.pairing_window_s =
      table.number_or("pairing_window_ms", stereo.pairing_window_s * kMsPerSecond, {0.01, 1000.0}) / kMsPerSecond;
  const double rate_hz = stereo.devices[0].frame_rate_hz;
  if (rate_hz > 0.0 && stereo.pairing_window_s * rate_hz >= 0.5) {
    table.fail("pairing_window_ms",
               "must be below half of what passes between frames at frame_rate_hz, or a frame "
               "could pair with its partner's neighbour");
  }
}

void read_devices(const TomlTable& table, StereoConfig& stereo, ConfigErrors& errors) {
  std::string format = "Mono8";
  errors.attempt([&] { format = table.choice_or("pixel_format", format, {"Mono8", "Mono16"}); });
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    CameraSettings& device = stereo.devices[side];
    errors.attempt([&] {
      read_which_camera(table.table_or_empty(kSides[side]), "frames = \"DIRECTORY\" for the rig", device, errors);
    });
    device.format = format == "Mono8" ? CameraFormat::kMono8 : CameraFormat::kMono16;
    read_transport(table, device, errors);
  }
}

void read_slam_of(const TomlTable& table, const fs::path& folder, const Environment& environment, StereoConfig& stereo,
                  ConfigErrors& errors) {
  if (!stereo.slam) {
    if (table.has("slam")) table.fail("slam", "is of a system that systems does not name; add it there");
    return;
  }
  const TomlTable slam = table.table_or_empty("slam");
  read_slam(slam, folder, *stereo.slam, errors);
  check_vocabulary(slam, environment, *stereo.slam);
}

StereoConfig read_stereo(const TomlTable& table, const fs::path& folder, const Environment& environment,
                         ConfigErrors& errors) {
  StereoConfig stereo;
  errors.attempt([&] { stereo.name = read_name(table, "name", table.text("name")); });
  errors.attempt([&] { stereo.target = read_name(table, "target", table.text("target")); });
  const bool knows_systems = errors.attempt([&] { read_systems(table, stereo); });
  if (knows_systems) {
    errors.attempt([&] { read_slam_of(table, folder, environment, stereo, errors); });
  } else if (table.has("slam")) {
    SlamConfig perhaps;
    errors.attempt([&] { read_slam(table.table("slam"), folder, perhaps, errors); });
  }
  const bool knows_rig = errors.attempt([&] { read_rig(table, folder, environment, stereo); });
  if (!table.has("frames")) {
    read_devices(table, stereo, errors);
  } else {
    refuse_beside_frames(table, {"left", "right", "pixel_format", "packet_size", "ptp", "pairing_window_ms"}, errors);
    // Pairs must have its size.
    if (knows_rig) errors.attempt([&] { read_frames(table, folder, environment, stereo); });
  }
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    CameraSettings& device = stereo.devices[side];
    const PinholeCamera& intrinsics = side == 0 ? stereo.rig.left.intrinsics : stereo.rig.right.intrinsics;
    errors.attempt([&] { read_frame_rate(table, device); });
    device.width_px = intrinsics.width_px;
    device.height_px = intrinsics.height_px;
  }
  if (!table.has("frames")) errors.attempt([&] { read_window(table, stereo); });
  errors.add_unknown_keys(table);
  return stereo;
}

// The keys and values of a camera's `serial` and `address`, if given.
std::vector<std::string> marks_of(const CameraSettings& device) {
  std::vector<std::string> marks;
  if (!device.serial.empty()) marks.push_back("serial " + device.serial);
  if (!device.address.empty()) marks.push_back("address " + device.address);
  return marks;
}

}  // namespace

std::vector<StereoConfig> read_stereos(const TomlTable& root, const fs::path& folder, const Environment& environment,
                                       const std::vector<TofConfig>& cameras, ConfigErrors& errors) {
  std::vector<StereoConfig> stereos;
  std::set<std::string> names, taken;
  for (const TofConfig& camera : cameras) {
    for (const std::string& mark : marks_of(camera.device)) taken.insert(mark);
  }
  for (const TomlTable& table : root.tables("stereo")) {
    stereos.push_back(read_stereo(table, folder, environment, errors));
    const StereoConfig& stereo = stereos.back();
    errors.attempt([&] {
      if (stereo.name.empty() || names.insert(stereo.name).second) return;
      table.fail("name", "\"" + stereo.name + "\" is taken by another rig");
    });
    for (std::size_t side = 0; side < kSides.size(); ++side) {
      for (const std::string& mark : marks_of(stereo.devices[side])) {
        if (taken.insert(mark).second) continue;
        const std::size_t blank = mark.find(' ');
        errors.attempt([&] {
          table.table_or_empty(kSides[side])
              .fail(mark.substr(0, blank), "\"" + mark.substr(blank + 1) + "\" is taken by another camera");
        });
      }
    }
  }
  return stereos;
}

}  // namespace pharos::host
