// SPDX-License-Identifier: Apache-2.0
#include "host/device/gige_module.hpp"

#include <memory>

#include "host/device/gige_source.hpp"

extern "C" pharos::host::FrameSource* pharos_open_gige_source(const pharos::host::CameraSettings& settings) {
  return std::make_unique<pharos::host::GigeSource>(settings).release();
}
