// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

#include "host/device/camera_settings.hpp"

namespace pharos::host {

/// To be called first: the process will end with its parent, ignores signals of the terminal and of systemd (the parent
/// handles them) and writes no core files.
void bind_to_parent();
/// Whether `parent` is still this process' parent.
bool is_child_of(pid_t parent);

/// Limit of a camera process' address space, bytes: libraries and threads without frames, twice the frames that Aravis
/// fills, and the shared memory.
std::size_t address_space_limit(const CameraSettings& settings);
/// Sets the limit. Does nothing in builds with the address sanitizer, which reserves terabytes of address space.
void limit_address_space(std::size_t bytes);

}  // namespace pharos::host
