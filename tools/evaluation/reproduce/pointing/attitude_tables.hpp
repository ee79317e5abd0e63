// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Paper 003's tables 1 and 2: its four attitudes, rendered and measured by its method as printed
/// (tools/pointing/paper) and by ours, at 100 m before a telescope of 6000 px, and with a focal length of 1 m.
///
/// Table 1's station columns are what is rendered, so what is compared is whether they come back. Its Earth-fixed
/// columns cannot be had from them by any rotation; ours are WGS-84's for the paper's station. Table 2: the angle
/// between long and short side. With `folder` also the pictures of figures 8 and 9 are written there.
report::PartResult reproduce_attitudes(std::uint64_t seed, const std::filesystem::path& folder = {});

/// The part `line` of the report.
report::Part line_part();

}  // namespace pharos::tools
