// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace pharos::tools {

/// What the image `decoder`, whole, spends of a 50 MHz core on twelve sensors and two stations at full rate.
struct CpuLoad {
  double percent = 0.0;  // mean over whole seconds: edges, frames, line and what is said by the clock
  double lost = 0.0;     // edges and frames that it lost or skipped
};

/// On a core of so many cycles an instruction, time moving with its instructions (capture_replay.hpp). Throws
/// host::InputError when QEMU or the image is missing.
CpuLoad cpu_load(const std::filesystem::path& images, int cycles);

}  // namespace pharos::tools
