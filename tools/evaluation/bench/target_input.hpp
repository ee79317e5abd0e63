// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "tools/evaluation/bench/bench_network.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::tools {

/// A target with any number of sensors, distributed evenly over a hemisphere of 6 cm radius, all visible.
Target dome_target(int sensors);

/// A recording's light in the format of measure_light: edges in the order of their stamps, without a target (only the
/// decoder is measured). Throws host::InputError when it cannot be read.
std::vector<char> recorded_light(const std::string& edges);

/// Some seconds of a dome of so many sensors with two stations at full rate, every sensor hit in every sweep; with the
/// stations' OOTX, so that poses are computed.
std::vector<char> simulated_light(int sensors);

/// A flight's hits in the format of measure_network.
std::vector<char> network_hits(const NetworkFlight& flight);

/// The light of `simulated_light` in the form of the emulated capture block (sim::CaptureFeed), to a core of so many
/// cycles an instruction.
std::vector<char> simulated_words(int sensors, double cycles);

/// Pose problems in the format of measure_pose, with a prior of a cycle's motion and the host's result. The last
/// `from_nothing` are also solved without the prior. `host_..._us`: medians of the host's time per solve.
struct PoseInput {
  std::vector<char> bytes;
  double host_warm_us = 0.0, host_nothing_us = 0.0;
};
PoseInput pose_problems(const Target& target, int min_seen, int max_seen, int problems, int from_nothing);

}  // namespace pharos::tools
