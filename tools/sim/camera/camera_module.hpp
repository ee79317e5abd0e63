// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/camera/camera_play.hpp"

namespace pharos::sim {

/// serve_camera, out of the module beside this program. Aravis lives in there: loading it costs 5 ms, which no other
/// subcommand should pay. Throws host::InputError where the module is missing.
CameraPlaySummary serve_camera_by_module(const FrameSequence& sequence, const CameraPlay& play);

inline constexpr const char* kCameraModuleName = "libpharos_sim_camera.so";
inline constexpr const char* kCameraFunctionName = "pharos_serve_camera";
using CameraFunction = void (*)(const FrameSequence&, const CameraPlay&, CameraPlaySummary&);

}  // namespace pharos::sim
