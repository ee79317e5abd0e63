// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/cameras/docking_target.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::host {

/// Puts a target description into the settings of the depth camera's path: connectors, and limits of the ring's radii
/// where they are stated, so that another ring is none. `name` stands for the file in messages. Throws InputError where
/// it has more connectors than can be used.
void apply_target(const DockingTarget& target, const std::string& name, tof::TofSettings& settings);

}  // namespace pharos::host
