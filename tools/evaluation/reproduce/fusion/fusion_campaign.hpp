// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// What a campaign runs: `faults` empty is all kinds.
struct FusionCampaign {
  int runs = 1000;
  int consistency_runs = 100;
  std::uint64_t seed = 1;
  std::vector<std::string> faults;
};

/// Names of the kinds of fault: step, ramp, freeze, wrong_time, wrong_scale, mirrored, wrong_target, outliers.
std::vector<std::string> fusion_fault_names();

/// Rows of `pharos reproduce fusion`; `step` is called after every run.
std::vector<ComparisonRow> run_fusion_campaign(const FusionCampaign& campaign, const std::function<void()>& step);

}  // namespace pharos::tools
