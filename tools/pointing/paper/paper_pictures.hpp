// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/pointing/paper/paper_line.hpp"

namespace pharos::tools::paper003 {

/// Figure 9 of the paper: `binary.png`, `segments.png` (all of LSD's, the panel's edges in green) after `prefix`.
/// Throws host::InputError where they cannot be written.
void write_stage_pictures(const std::string& prefix, const Stages& stages, std::int32_t width_px,
                          std::int32_t height_px);

}  // namespace pharos::tools::paper003
