// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/sim/approach/approach_simulator.hpp"

namespace pharos::sim {

/// What is written beside the defaults.
struct ApproachOutput {
  double start_s = 0.0;        // added to every time
  std::vector<bool> raw = {};  // sources that have no table and no slow error: their raw data are simulated
  bool is_raw(std::size_t source) const { return source < raw.size() && raw[source]; }
};

struct ApproachSummary {
  std::vector<std::size_t> seen, refused;  // rows of each source
};

/// Writes NAME.csv of each source (the columns of its command, and time_s, arrival_s, the full covariance), truth.csv,
/// mounting.toml, mounting_true.toml, faults.csv. The folder is created if needed. Throws host::InputError.
ApproachSummary write_approach(const ApproachSimulator& simulator, const std::filesystem::path& folder,
                               const ApproachOutput& output = {});

/// The table of one source.
void write_source_table(const std::filesystem::path& path, host::SourceKind kind,
                        const std::vector<ApproachMeasurement>& measurements);

}  // namespace pharos::sim
