// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Figure 4 of paper 004: a view in ambient light of 0.01, and what LIME (ours, with BM3D), BIMEF, Dong's method, MSRCR
/// and SRIE make of it (tools/evaluation/low_light). Rows: ORB matches between two views 5 deg apart that agree with
/// one fundamental matrix, glow beside the target, processor time of a picture. In them "theirs" is the other method.
/// With `folder` a picture each. Seen by own rays.
report::PartResult reproduce_figure_four(std::uint64_t seed, const std::filesystem::path& folder = {});

}  // namespace pharos::tools
