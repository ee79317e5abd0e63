// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// What was written.
struct RecordingSummary {
  std::uint64_t pulses = 0;
  double duration_s = 0.0;
  std::size_t faults = 0;
};

/// Simulates the scenario into `directory` (made if need be): edges.csv.gz, truth.csv, target.csv (nominal),
/// target_true.csv (as built), stations.toml (what the stations say of themselves), stations_true.toml, faults.csv.
/// Throws host::InputError when it cannot be written.
RecordingSummary write_recording(const LighthouseScenario& scenario, std::uint64_t seed,
                                 const std::filesystem::path& directory);

}  // namespace pharos::sim
