// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace pharos::tools {

/// Load of a 50 MHz core by the complete program `decoder`, with twelve sensors and two stations at full rate.
struct CpuLoad {
  double percent = 0.0;  // mean over whole seconds: edges, frames, serial line and periodic messages
  double lost = 0.0;     // edges and frames lost or skipped
};

/// For a core of so many cycles an instruction; time advances with the instructions (capture_replay.hpp). Throws
/// host::InputError when QEMU or the image is missing.
CpuLoad cpu_load(const std::filesystem::path& images, double cycles);

}  // namespace pharos::tools
