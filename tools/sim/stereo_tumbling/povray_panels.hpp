// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/sim/stereo_tumbling/panel_scene.hpp"

namespace pharos::sim {

/// Textures as 16-bit PNG files FOLDER/texture_N.png, for POV-Ray's image maps.
void write_texture_files(const PanelScene& scene, const std::string& folder);

/// The panels of a scene as POV-Ray meshes that are painted with those files, and its lamp. Without a gloss the light
/// is cast_panels' own; `gloss` adds highlights of foil.
std::string povray_panels(const PanelScene& scene, const Lighting& lighting, const std::string& texture_folder,
                          double gloss);

}  // namespace pharos::sim
