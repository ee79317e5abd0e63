// SPDX-License-Identifier: Apache-2.0
#include "host/config/source_table.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace pharos::host {
namespace {

constexpr std::size_t kTableColumns = 5;
using TableRow = std::array<std::string, kTableColumns>;

std::string device_words(const CameraSettings& device) {
  const std::string serial = device.serial.empty() ? "" : "serial number " + device.serial;
  return serial + (device.address.empty() ? "" : (serial.empty() ? "" : " at ") + device.address);
}

TableRow row_of(const TargetConfig& target, const DaemonConfig& config) {
  const std::string input = target.is_replay() ? "recording " + target.replay_file().string()
                                               : target.port + ", " + std::to_string(target.baud) + " baud";
  const std::string measures = target.generation == 2                  ? "pose in the world, a sweep"
                               : target.method == TrackMethod::kMotion ? "pose in each station's frame, a sweep"
                                                                       : "pose in each station's frame, a cycle";
  return {"lighthouse/" + config.source + (target.is_replay() ? "/replay" : ""), target.name, input, measures,
          config.lcm.channel_prefix + "LIGHTHOUSE_POSE"};
}

TableRow row_of(const TofConfig& camera, const DaemonConfig& config) {
  const std::string measures = camera.average_frames == 1 ? "pose of the docking ring, a frame"
                                                          : "pose of the docking ring, mean of " +
                                                                std::to_string(camera.average_frames) + " frames";
  return {"tof/" + camera.name, camera.target,
          camera.is_recorded() ? "frames " + camera.frames.string() : device_words(camera.device), measures,
          config.lcm.channel_prefix + "TOF_POSE"};
}

TableRow row_of(const PointingConfig& telescope, const DaemonConfig& config) {
  return {"line/" + telescope.name, telescope.target, "images " + telescope.directory.string(),
          telescope.law ? "panel axis, an image and a pass" : "panel axis, an image",
          config.lcm.channel_prefix + "LINE_POINTING"};
}

void add_rows(const StereoConfig& stereo, const DaemonConfig& config, std::vector<TableRow>& rows) {
  const std::string input = stereo.is_recorded()
                                ? "pairs " + stereo.frames.string()
                                : device_words(stereo.devices[0]) + " | " + device_words(stereo.devices[1]);
  if (stereo.ring2) {
    rows.push_back({"ring2/" + stereo.name, stereo.target, input, "pose of ring and nozzle, a pair",
                    config.lcm.channel_prefix + "RING2_POSE"});
  }
  if (stereo.slam) {
    rows.push_back({"slam/" + stereo.name, stereo.target, input, "pose relative to the first pair, spin",
                    config.lcm.channel_prefix + "SLAM_POSE"});
  }
}

TableRow row_of(const RemoteConfig& remote) {
  return {"remote/" + remote.name, remote.target, remote.source + (remote.daemon.empty() ? "" : " of " + remote.daemon),
          "nothing itself: another daemon's poses", remote.channel};
}

TableRow row_of(const VehicleConfig& vehicle, const DaemonConfig& config) {
  std::string input;
  for (const FusedSourceConfig& source : vehicle.sources) input += (input.empty() ? "" : " + ") + source.mounting.name;
  std::ostringstream rate;
  rate << vehicle.rate_hz;
  return {"fusion/" + config.source, vehicle.target, input,
          "state in the vehicle's frame, a pose and " + rate.str() + "/s", config.lcm.channel_prefix + "TARGET_STATE"};
}

}  // namespace

std::vector<std::string> source_table(const DaemonConfig& config) {
  std::vector<TableRow> rows = {{"SOURCE", "TARGET", "INPUT", "MEASURES", "CHANNEL"}};
  for (const TargetConfig& target : config.targets) rows.push_back(row_of(target, config));
  for (const TofConfig& camera : config.cameras) rows.push_back(row_of(camera, config));
  for (const StereoConfig& stereo : config.stereos) add_rows(stereo, config, rows);
  for (const PointingConfig& telescope : config.telescopes) rows.push_back(row_of(telescope, config));
  for (const RemoteConfig& remote : config.remotes) rows.push_back(row_of(remote));
  if (config.vehicle) rows.push_back(row_of(*config.vehicle, config));
  std::array<std::size_t, kTableColumns> widths{};
  for (const TableRow& row : rows) {
    for (std::size_t k = 0; k < kTableColumns; ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::vector<std::string> lines;
  for (const TableRow& row : rows) {
    std::string line;
    for (std::size_t k = 0; k + 1 < kTableColumns; ++k)
      line += row[k] + std::string(widths[k] - row[k].size() + 2, ' ');
    lines.push_back(line + row.back());
  }
  return lines;
}

}  // namespace pharos::host
