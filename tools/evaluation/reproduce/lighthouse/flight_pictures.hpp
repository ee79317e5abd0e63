// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "tools/evaluation/report/part.hpp"
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"

namespace pharos::tools {

/// One answer of a flight beside the truth.
struct FlightPoint {
  double time_s = 0.0;
  LighthouseFromBody estimate, truth;
  PoseError sigma;  ///< as stated
};
using FlightSeries = std::vector<FlightPoint>;

/// Figures 6 (trajectory) and 7 (errors over time, with three sigmas of ours) of paper 002.
void add_flight_pictures(const FlightSeries& theirs, const FlightSeries& ours, const std::filesystem::path& folder,
                         report::PartResult& result);

}  // namespace pharos::tools
