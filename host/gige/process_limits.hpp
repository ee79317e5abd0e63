// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

#include "host/device/camera_settings.hpp"

namespace pharos::host {

/// First thing in the process: ends with its parent, leaves signals of the terminal and of systemd to it, leaves no
/// core files behind.
void bind_to_parent();
/// False where `parent` is no longer who started this process.
bool is_child_of(pid_t parent);

/// Address space that a camera's process may take: what libraries and threads take with no frame at all, twice the
/// frames that Aravis fills, and the shared memory.
std::size_t address_space_limit(const CameraSettings& settings);
/// Sets it. Nothing where the build has the address sanitizer, which takes terabytes of addresses.
void limit_address_space(std::size_t bytes);

}  // namespace pharos::host
