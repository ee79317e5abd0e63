// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include "host/gige/gobject.hpp"

namespace pharos::host {

/// Whether the camera offers the feature now.
inline bool has_feature(ArvDevice* device, const char* name) {
  ArvError error;
  return arv_device_is_feature_available(device, name, error.out()) != 0 && !error;
}

}  // namespace pharos::host
