// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Random poses of one ring, each frame with a third of it hidden.
struct CampaignOptions {
  double ring_outer_diameter_m = 1.1;
  double min_range_m = 2.5;
  double max_range_m = 6.0;
  int frames = 100;
  std::uint64_t seed = 1;
  bool hidden_third = true;
  int first = 0;  // of the frames; the poses before are drawn, not measured
};

/// What became of a frame. A pose is wrong when it is off by more than 10 mm or 2 deg.
struct CampaignFrame {
  int number = 0;
  std::string outcome;  // "ok", "five_dof", "ambiguous", "off", "wrong", or the failure's name
  double error_mm = 0.0;
  double error_deg = 0.0;
  double nees = 0.0;  // error over covariance; 6 in the mean of an honest estimator
};

struct CampaignResult {
  int frames = 0;
  int good = 0;   // all six degrees of freedom, not wrong
  int wrong = 0;  // called good, wrong, and more than 5 sigma off
  double mean_nees = 0.0;
  double median_mm = 0.0;
  double median_deg = 0.0;
  std::map<std::string, int> outcomes;
};

/// `seen` is called after each frame.
CampaignResult run_campaign(const CampaignOptions& options, const std::function<void(const CampaignFrame&)>& seen);

/// Two rings: 1.1 m from 2.5 to 6 m, 0.6 m from 1.5 to 4 m, `frames` each.
std::vector<ComparisonRow> reproduce_success(int frames, std::uint64_t seed);

}  // namespace pharos::tools
