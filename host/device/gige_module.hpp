// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/device/camera_settings.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// GigE Vision is a library that is loaded where a camera is configured: who has none needs no Aravis.
inline constexpr const char* kGigeModuleName = "libpharos_gige.so";
inline constexpr const char* kGigeModuleFunction = "pharos_open_gige_source";

/// The caller owns what it gets.
using GigeModuleFunction = FrameSource* (*)(const CameraSettings& settings);

}  // namespace pharos::host
