// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/camera_input.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "host/camera_link/camera_source.hpp"
#include "host/frame_record/recorded_camera.hpp"
#include "host/frame_record/recording_camera.hpp"
#include "host/record/recording_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// So that the limit deletes an eighth of what there is at most.
constexpr std::uint64_t kFilesInLimit = 8;

FrameRecorderOptions options_of(const RecordingConfig& recording, const std::string& name) {
  FrameRecorderOptions options;
  options.directory = recording.directory;
  options.camera = name;
  options.rotate_s = recording.rotate_s;
  options.limit_bytes = recording.camera_limit_bytes;
  options.rotate_bytes = std::min(options.rotate_bytes, recording.camera_limit_bytes / kFilesInLimit);
  return options;
}

}  // namespace

std::unique_ptr<FrameSource> open_recorded_camera(const SourceContext& context, const CameraSettings& settings,
                                                  const std::string& name) {
  std::unique_ptr<FrameSource> camera = open_camera(settings);
  const auto& recording = context.config.recording;
  if (!recording || !recording->cameras) return camera;
  return std::make_unique<RecordingCamera>(std::move(camera), options_of(*recording, name));
}

std::unique_ptr<FrameSource> replayed_camera(const SourceContext& context, const std::filesystem::path& frames,
                                             const CameraSettings& settings, const std::string& name) {
  std::vector<std::filesystem::path> files = recording_files(frames, name, kFramesSuffix);
  if (files.empty()) throw InputError(frames.string() + ": has no recording of camera \"" + name + "\"");
  return std::make_unique<RecordedCamera>(std::move(files), settings, context.replay, context.replay_speed);
}

void add_recording(NamedCounts& counts, const std::string& head, const FrameSourceStatus& camera) {
  if (!camera.recording) return;
  counts.push_back({head + "frames", camera.recording->frames});
  counts.push_back({head + "frames_lost", camera.recording->frames_lost});
  counts.push_back({head + "files", camera.recording->files});
  counts.push_back({head + "files_deleted", camera.recording->files_deleted});
  counts.push_back({head + "failures", camera.recording->failures});
}

}  // namespace pharos::host
