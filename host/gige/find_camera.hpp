// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/device/camera_settings.hpp"
#include "host/gige/gobject.hpp"

namespace pharos::host {

/// The camera with that address or serial number, with control access. Throws CameraError: not found, not the
/// configured camera, or in use by another program. By address it takes 5 ms if the camera responds and 2.5 s if not;
/// by serial number 1 s more, for the search.
GObjectPtr<ArvCamera> find_camera(const CameraSettings& settings);

std::string serial_of(ArvCamera* camera);
/// IP address, as text.
std::string address_of(ArvCamera* camera);
/// The same as a number in host byte order; 0 if there is none.
std::uint32_t ip_of(ArvCamera* camera);

}  // namespace pharos::host
