// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/images/grey_image.hpp"
#include "host/vision/ring2/ring2_detector.hpp"

namespace pharos::tools {

/// Draws both images side by side with all ellipses found, those taken for ring and nozzle, and where the answer puts
/// both circles and their axis. Throws InputError where the file cannot be written.
void write_ring2_overlay(const std::string& path, const std::array<host::GreyImage, 2>& images, const ring2::Rig& rig,
                         const host::Ring2Detection& circles);

}  // namespace pharos::tools
