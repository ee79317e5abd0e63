// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::tools {

/// Sensors spread evenly over half a ball of 6 cm radius, seen from every side: a target of any number of them.
Target dome_target(int sensors);

/// A recording's light as measure_light reads it: edges in the order of their stamps, each sensor of the recording a
/// sensor of no target (what is measured is the decoder). Throws host::InputError when it cannot be read.
std::vector<char> recorded_light(const std::string& edges);

/// Some seconds of a dome of so many sensors before two stations at full rate, every sensor hit in every sweep; what
/// the stations say of themselves, so that poses come with it.
std::vector<char> simulated_light(int sensors);

/// The same light as the emulated capture block gives it (sim::CaptureFeed), to a core of so many cycles an
/// instruction.
std::vector<char> simulated_words(int sensors, int cycles);

/// Pose problems as measure_pose reads them, with a prior of a cycle's motion and the host's answer. The last
/// `from_nothing` are to be solved without the prior too. `host_us`: medians of the host's time a solve.
struct PoseInput {
  std::vector<char> bytes;
  double host_warm_us = 0.0, host_nothing_us = 0.0;
};
PoseInput pose_problems(const Target& target, int min_seen, int max_seen, int problems, int from_nothing);

}  // namespace pharos::tools
