// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Figure 4 in colour: golden foil, blue cells. Matches of two views in ambient light of 0.01, as they are, by LIME of
/// the luma and by LIME of the colours (max-RGB, BM3D on Y of YCbCr, as paper 004 has it); and 10 deg of stereo pairs
/// in ambient light of 0.1, tracked each way with the fast denoiser. With `folder` a picture as it is and enhanced.
report::PartResult reproduce_colour_pairs(std::uint64_t seed, const std::filesystem::path& folder = {});

}  // namespace pharos::tools
