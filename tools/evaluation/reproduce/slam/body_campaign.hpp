// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tools/sim/stereo_tumbling/body_sequence.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

struct BodyCampaign {
  int bodies = 0;
  std::uint64_t seed = 1;  ///< of the first body; the next ones follow
  sim::BodyScenario scenario;
  int features = 1000;
  std::function<void()> step;  ///< called after every pair
};

/// `pharos slam` over one satellite drawn at random. Errors are of pairs with a pose, of the whole run's last map.
struct BodyFigures {
  std::uint64_t seed = 0;
  bool symmetric = false;
  int pairs = 0, placed = 0, lost = 0, ambiguous_place = 0;
  double rmse_deg = 0.0, last_deg = 0.0, largest_deg = 0.0;
  /// Of closed loops, by the truth: wrong where the measured rotation is off by more than 3 deg.
  int loops_right = 0, loops_wrong = 0, loops_taken_back = 0;
  /// RMS of errors over stated sigmas, per degree of freedom: of the results of push(), and of the last map.
  double live_attitude_over_sigma = 0.0, live_position_over_sigma = 0.0;
  double attitude_over_sigma = 0.0, position_over_sigma = 0.0;
  bool steady_rotation = false;  ///< the last map's attitudes are on a steady rotation
};

BodyFigures run_body(const BodyCampaign& campaign, std::uint64_t seed);

/// A row a body as soon as it is there (CSV, JSON) or a Markdown table, rounded; then over all bodies the worst (loops
/// and pairs: the sum) and the median. Returns the rows of the bodies.
std::vector<BodyFigures> run_bodies(const BodyCampaign& campaign, bool markdown, const OutputOptions& output);

}  // namespace pharos::tools
