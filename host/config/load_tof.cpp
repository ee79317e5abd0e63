// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_tof.hpp"

#include <set>

#include "host/cameras/tof_target.hpp"
#include "host/config/config_parts.hpp"
#include "host/config/load_device.hpp"
#include "pharos/tof/connector_choice.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxAveraged = 1000;  // half a minute at 30 frames/s

DepthCamera read_camera_of(const TomlTable& table, const fs::path& file, const Environment& environment) {
  DepthCamera camera;
  try {
    camera = environment.read_camera(file.string()).camera;
  } catch (const InputError& error) {
    table.fail("camera_file", error.what());
  }
  const PinholeCamera& intrinsics = camera.intrinsics;
  if (intrinsics.width_px > tof::kMaxWidth_px || intrinsics.height_px > tof::kMaxHeight_px) {
    table.fail("camera_file", file.string() + ": " + std::to_string(intrinsics.width_px) + " x " +
                                  std::to_string(intrinsics.height_px) + " pixels are more than " +
                                  std::to_string(tof::kMaxWidth_px) + " x " + std::to_string(tof::kMaxHeight_px));
  }
  return camera;
}

void read_frames(const TomlTable& table, const fs::path& folder, const Environment& environment, TofConfig& camera) {
  camera.frames = read_path(table, "frames", folder);
  try {
    camera.replays_camera = environment.check_frames(camera.frames, camera.name);
  } catch (const InputError& error) {
    table.fail("frames", error.what());
  }
}

void read_device(const TomlTable& table, CameraSettings& device, ConfigErrors& errors) {
  read_which_camera(table, "frames = \"DIRECTORY\"", device, errors);
  errors.attempt([&] {
    device.mode = table.text_or("mode", "");
    if (table.has("mode") && (device.mode.empty() || !all_of_set(device.mode, "_"))) {
      table.fail("mode", "must be a word of the camera's Scan3dOperatingMode, as Distance5000mmMultiFreq");
    }
  });
  read_transport(table, device, errors);
}

tof::RingSettings read_ring(const TomlTable& table, ConfigErrors& errors) {
  tof::RingSettings ring;
  constexpr Range kRadius_m{0.02, 10.0};
  const std::size_t before = errors.count();
  errors.attempt(
      [&] { ring.min_outer_radius_m = table.number_or("least_outer_radius_m", ring.min_outer_radius_m, kRadius_m); });
  errors.attempt(
      [&] { ring.max_outer_radius_m = table.number_or("most_outer_radius_m", ring.max_outer_radius_m, kRadius_m); });
  if (errors.count() != before || ring.max_outer_radius_m > ring.min_outer_radius_m) return ring;
  errors.attempt([&] {
    table.fail(table.has("most_outer_radius_m") ? "most_outer_radius_m" : "least_outer_radius_m",
               "the most must be more than the least");
  });
  return ring;
}

// What is known of ring and connectors, in place of the limits of [camera.ring].
void read_target_of(const TomlTable& table, const fs::path& folder, const Environment& environment, TofConfig& camera) {
  camera.target_file = read_path(table, "target_file", folder);
  DockingTarget target;
  try {
    target = environment.read_docking_target(camera.target_file.string());
    apply_target(target, camera.target_file.string(), camera.tof);
  } catch (const InputError& error) {
    table.fail("target_file", error.what());
  }
  if (target.outer_radius && table.has("ring")) {
    table.fail("ring", "is in " + camera.target_file.string() + " already; leave one of them out");
  }
  if (!target.connectors.empty() && table.has("connectors")) {
    table.fail("connectors", "are in " + camera.target_file.string() + " already; leave one of them out");
  }
}

TofConfig read_camera_table(const TomlTable& table, const fs::path& folder, const Environment& environment,
                            ConfigErrors& errors) {
  TofConfig camera;
  errors.attempt([&] { camera.name = read_name(table, "name", table.text("name")); });
  errors.attempt([&] { camera.target = read_name(table, "target", table.text("target")); });
  errors.attempt([&] {
    camera.camera_file = read_path(table, "camera_file", folder);
    camera.camera = read_camera_of(table, camera.camera_file, environment);
  });
  if (table.has("frames")) {
    refuse_beside_frames(table, {"serial", "address", "mode", "packet_size", "ptp"}, errors);
    errors.attempt([&] { read_frames(table, folder, environment, camera); });
  } else {
    read_device(table, camera.device, errors);
  }
  errors.attempt([&] { read_frame_rate(table, camera.device); });
  camera.device.width_px = camera.camera.intrinsics.width_px;
  camera.device.height_px = camera.camera.intrinsics.height_px;
  errors.attempt([&] {
    camera.average_frames =
        static_cast<int>(table.integer_or("average_frames", camera.average_frames, 1, kMaxAveraged));
  });
  errors.attempt([&] { camera.tof.ring = read_ring(table.table_or_empty("ring"), errors); });
  errors.attempt([&] {
    auto& expected = camera.tof.connector.expected;
    expected = static_cast<std::int32_t>(table.integer_or("connectors", expected, 1, tof::kMaxConnectors));
  });
  if (table.has("target_file")) {
    errors.attempt([&] { read_target_of(table, folder, environment, camera); });
  }
  errors.add_unknown_keys(table);
  return camera;
}

}  // namespace

std::vector<TofConfig> read_tof_cameras(const TomlTable& root, const fs::path& folder, const Environment& environment,
                                        ConfigErrors& errors) {
  std::vector<TofConfig> cameras;
  std::set<std::string> names;
  std::set<std::string> devices;
  for (const TomlTable& table : root.tables("camera")) {
    cameras.push_back(read_camera_table(table, folder, environment, errors));
    const TofConfig& camera = cameras.back();
    errors.attempt([&] {
      if (camera.name.empty() || names.insert(camera.name).second) return;
      table.fail("name", "\"" + camera.name + "\" is taken by another camera");
    });
    for (const char* key : {"serial", "address"}) {
      const std::string& device = key[0] == 's' ? camera.device.serial : camera.device.address;
      if (device.empty() || devices.insert(key + device).second) continue;
      errors.attempt([&] { table.fail(key, "\"" + device + "\" is taken by another camera"); });
    }
  }
  return cameras;
}

}  // namespace pharos::host
