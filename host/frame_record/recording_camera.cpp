// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/recording_camera.hpp"

namespace pharos::host {

DepthFramePtr RecordingCamera::take() {
  DepthFramePtr frame = camera_->take();
  if (frame) recorder_.append(*frame);
  return frame;
}

FrameSourceStatus RecordingCamera::status() const {
  FrameSourceStatus status = camera_->status();
  status.recording = recorder_.counters();
  return status;
}

}  // namespace pharos::host
