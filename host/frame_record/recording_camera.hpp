// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "host/device/frame_source.hpp"
#include "host/frame_record/frame_recorder.hpp"

namespace pharos::host {

/// A camera whose frames are recorded as they are taken.
class RecordingCamera final : public FrameSource {
 public:
  RecordingCamera(std::unique_ptr<FrameSource> camera, FrameRecorderOptions options)
      : camera_(std::move(camera)), recorder_(std::move(options)) {}

  int fd() const override { return camera_->fd(); }
  DepthFramePtr take() override;
  void recycle(DepthFramePtr frame) override { camera_->recycle(std::move(frame)); }
  FrameSourceStatus status() const override;
  std::string device() const override { return camera_->device(); }
  std::string storage_error() const override { return recorder_.error(); }

 private:
  std::unique_ptr<FrameSource> camera_;
  FrameRecorder recorder_;
};

}  // namespace pharos::host
