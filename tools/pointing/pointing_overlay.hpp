// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/vision/pointing/measure_panel.hpp"

namespace pharos::tools {

/// The image with the outline's edges (grey), the long sides used (green), the short ones (blue) and the answer in
/// words. Throws host::InputError where the file cannot be written.
void write_pointing_overlay(const std::string& path, ImageView<const std::uint16_t> image, const PinholeCamera& camera,
                            const pointing::PanelMeasurement& panel, const pointing::PointingResult& answer);
/// The image with the reason why it has no answer.
void write_pointing_overlay(const std::string& path, ImageView<const std::uint16_t> image, const std::string& status);

}  // namespace pharos::tools
