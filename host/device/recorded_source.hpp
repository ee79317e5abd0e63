// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/device/frame_directory.hpp"
#include "host/device/frame_source.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Recorded frames, once and in order, as if a camera took them now. A file that cannot be read is counted and skipped.
class RecordedSource : public FrameSource {
 public:
  /// `frame_rate_hz` 0: as fast as they are taken. Throws InputError if there are no frames.
  RecordedSource(const std::string& directory, std::int32_t width_px, std::int32_t height_px, double frame_rate_hz);

  int fd() const override { return timer_.fd(); }
  DepthFramePtr take() override;
  void recycle(DepthFramePtr frame) override { blank_ = std::move(frame); }
  FrameSourceStatus status() const override { return status_; }
  std::string device() const override { return path_; }

 private:
  void arm();

  std::string path_;
  FrameDirectory directory_;
  std::int32_t width_px_;
  std::int32_t height_px_;
  double frame_rate_hz_;
  Timer timer_;
  std::size_t next_ = 0;
  DepthFramePtr blank_;
  FrameSourceStatus status_;
};

}  // namespace pharos::host
