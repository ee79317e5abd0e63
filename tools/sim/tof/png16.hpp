// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace pharos::sim {

/// Writes a grey PNG of 16 bits. Throws host::InputError when it cannot be written.
void write_png16(const std::filesystem::path& path, int width_px, int height_px,
                 const std::vector<std::uint16_t>& pixels);

}  // namespace pharos::sim
