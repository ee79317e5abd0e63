// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// Statistics of the output.
struct RecordingSummary {
  std::uint64_t pulses = 0;
  double duration_s = 0.0;
  std::size_t faults = 0;
};

/// Simulates the scenario into `directory` (created if needed): edges.csv.gz, truth.csv, target.csv (nominal),
/// target_true.csv, stations.toml (announced by the stations), stations_true.toml, faults.csv. Throws host::InputError
/// if it cannot be written.
RecordingSummary write_recording(const LighthouseScenario& scenario, std::uint64_t seed,
                                 const std::filesystem::path& directory);

}  // namespace pharos::sim
