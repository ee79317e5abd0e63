// SPDX-License-Identifier: Apache-2.0
#include "host/config/replay_config.hpp"

#include <filesystem>

#include "host/record/recording_file.hpp"
#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// The configuration without its sources, and without what was said of their ports and folders.
DaemonConfig without_sources(const DaemonConfig& config) {
  DaemonConfig replay = config;
  static_cast<SourceConfigs&>(replay) = {};
  std::erase_if(replay.place_errors,
                [](const PlaceError& error) { return error.table == "target" || error.table == "telescope"; });
  return replay;
}

DaemonConfig replay_file(const DaemonConfig& config, const std::string& file) {
  const std::string recorded = StreamReader(ByteSource(file)).header().target;
  const TargetConfig* chosen = config.targets.size() == 1 ? &config.targets.front() : nullptr;
  for (const TargetConfig& target : config.targets) {
    if (target.name == recorded) chosen = &target;
  }
  if (chosen == nullptr) {
    throw InputError(file + ": is a recording of target \"" + recorded + "\", which the configuration has not");
  }
  DaemonConfig replay = without_sources(config);
  replay.targets = {*chosen};
  replay.targets.front().port = TargetConfig::kReplayPrefix + file;
  return replay;
}

DaemonConfig replay_directory(const DaemonConfig& config, const std::string& directory) {
  DaemonConfig replay = without_sources(config);
  for (TargetConfig target : config.targets) {
    if (recording_files(directory, target.name, kStreamSuffix).empty()) continue;
    target.port = TargetConfig::kReplayPrefix + directory;
    replay.targets.push_back(target);
  }
  for (TofConfig camera : config.cameras) {
    if (!is_frame_recording(directory, camera.name)) continue;
    camera.frames = directory;
    camera.replays_camera = true;
    replay.cameras.push_back(camera);
  }
  for (StereoConfig stereo : config.stereos) {
    if (!is_frame_recording(directory, side_name(stereo.name, 0))) continue;
    stereo.frames = directory;
    stereo.replays_camera = true;
    replay.stereos.push_back(stereo);
  }
  if (replay.targets.empty() && replay.cameras.empty() && replay.stereos.empty()) {
    throw InputError(directory + ": has no recording of any source of this configuration");
  }
  return replay;
}

}  // namespace

DaemonConfig replay_config(const DaemonConfig& config, const std::string& path) {
  std::error_code error;
  DaemonConfig replay = fs::is_directory(path, error) ? replay_directory(config, path) : replay_file(config, path);
  replay.lcm.answer_clock = false;
  replay.recording.reset();  // what is played is recorded already
  return replay;
}

}  // namespace pharos::host
