// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/device/camera_settings.hpp"
#include "host/device/frame_source.hpp"
#include "host/frame_record/frame_reader.hpp"
#include "host/runtime/replay_timeline.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Recorded frames of a camera with their recorded times, in step with the other recordings of a replay. The frame's
/// age is by the timeline's clock.
class RecordedCamera final : public FrameSource {
 public:
  /// Frames that may be in use before the next one is played at full speed: those that wait for their partner in a
  /// pair.
  static constexpr int kMaxInUse = 6;

  /// `files` follow each other. `timeline` must outlive this. Throws InputError if the first one is no recording, or of
  /// another size or kind than the camera.
  RecordedCamera(std::vector<std::filesystem::path> files, const CameraSettings& settings,
                 std::shared_ptr<ReplayTimeline> timeline, ReplaySpeed speed);

  int fd() const override { return timer_.fd(); }
  DepthFramePtr take() override;
  void recycle(DepthFramePtr frame) override;
  FrameSourceStatus status() const override;
  std::string device() const override { return "recording " + files_.front().string(); }

 private:
  FrameReader open(const std::filesystem::path& file) const;
  void read_next();
  bool open_next_file();

  std::vector<std::filesystem::path> files_;
  CameraSettings settings_;
  std::shared_ptr<ReplayTimeline> timeline_;
  ReplaySpeed speed_;
  ReplayTimeline::Player player_ = 0;
  FrameReader reader_;
  std::size_t file_ = 0;  // that is read
  DepthFramePtr next_;
  std::vector<DepthFramePtr> free_;
  int in_use_ = 0;
  Timer timer_;
  FrameSourceStatus status_;
  FrameReaderCounters of_read_files_;
  std::int64_t files_unreadable_ = 0;
};

}  // namespace pharos::host
