// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// Statistics of the output.
struct Lh2RecordingSummary {
  std::uint64_t changes = 0;
  std::size_t passes = 0;
  std::size_t faults = 0;
  double duration_s = 0.0;
};

/// Simulates a scenario of generation 2 into `directory`: light.csv.gz, passes.csv, truth.csv (T_world_body),
/// target.csv, target_true.csv, stations.toml, stations_true.toml, faults.csv. Throws host::InputError if it cannot be
/// written.
Lh2RecordingSummary write_lh2_recording(const LighthouseScenario& scenario, std::uint64_t seed,
                                        const std::filesystem::path& directory);

}  // namespace pharos::sim
