// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/camera_module.hpp"

#include "host/support/module_function.hpp"

namespace pharos::sim {

CameraPlaySummary serve_camera_by_module(const FrameSequence& sequence, const CameraPlay& play) {
  const auto serve = reinterpret_cast<CameraFunction>(host::module_function(kCameraModuleName, kCameraFunctionName));
  CameraPlaySummary summary;
  serve(sequence, play, summary);
  return summary;
}

}  // namespace pharos::sim
