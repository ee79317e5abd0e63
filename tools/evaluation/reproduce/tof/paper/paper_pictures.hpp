// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "tools/evaluation/report/part.hpp"
#include "tools/evaluation/reproduce/tof/paper/paper_chain.hpp"

namespace pharos::tools::paper000 {

/// Figures 5 (ring) and 6 (connector) of the paper, a picture a step.
void add_stage_pictures(const ChainStages& stages, const std::filesystem::path& folder, report::PartResult& result);

}  // namespace pharos::tools::paper000
