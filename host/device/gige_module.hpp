// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "host/device/camera_settings.hpp"
#include "host/device/frame_source.hpp"
#include "host/support/module_function.hpp"

namespace pharos::host {

/// GigE Vision is a library that is loaded where a camera is configured: who has none needs no Aravis.
inline constexpr const char* kGigeModuleName = "libpharos_gige.so";
inline constexpr const char* kGigeModuleFunction = "pharos_open_gige_source";

/// The caller owns what it gets.
using GigeModuleFunction = FrameSource* (*)(const CameraSettings& settings);

/// That camera, out of the module. Throws InputError where the module is missing.
inline std::unique_ptr<FrameSource> open_gige_source(const CameraSettings& settings) {
  const auto open = reinterpret_cast<GigeModuleFunction>(module_function(kGigeModuleName, kGigeModuleFunction));
  return std::unique_ptr<FrameSource>(open(settings));
}

}  // namespace pharos::host
