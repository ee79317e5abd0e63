// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/camera_module.hpp"

extern "C" void pharos_serve_camera(const pharos::sim::FrameSequence& sequence, const pharos::sim::CameraPlay& play,
                                    pharos::sim::CameraPlaySummary& summary) {
  summary = pharos::sim::serve_camera(sequence, play);
}
