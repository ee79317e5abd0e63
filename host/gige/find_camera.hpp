// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/device/camera_settings.hpp"
#include "host/gige/gobject.hpp"

namespace pharos::host {

/// The camera of that address or serial number, under our control. Throws CameraError: not there, another camera than
/// meant, taken by another program. By address 5 ms where it answers and 2.5 s where none does; by serial number 1 s
/// more, for the search.
GObjectPtr<ArvCamera> find_camera(const CameraSettings& settings);

std::string serial_of(ArvCamera* camera);
/// IP address, as text.
std::string address_of(ArvCamera* camera);
/// The same as a number, host order; 0 where there is none.
std::uint32_t ip_of(ArvCamera* camera);

}  // namespace pharos::host
