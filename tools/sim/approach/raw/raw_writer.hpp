// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/sim/approach/approach_scenario.hpp"

namespace pharos::sim {

/// What is simulated of an approach.
enum class ApproachLevel : std::uint8_t {
  kMeasurements,  // poses of all sources
  kLight,         // the lighthouse's edges; poses of the others
  kImages,        // edges, depth frames, stereo pairs
};

/// Raw data of an approach: one body, one truth, every sensor by its own simulator.
struct RawApproach {
  ApproachScenario scenario;
  std::uint64_t seed = 1;
  ApproachLevel level = ApproachLevel::kLight;
  std::string target_file;  // sensors of the lighthouse's target
};

/// Images that write_raw_approach makes, for progress.
std::size_t image_count(const RawApproach& approach);

/// As write_approach, but a folder NAME of raw data in place of NAME.csv where the level has them; all times start at
/// kRawStart_s. One ring: that of tof is seen by ring2. `written` is called after each frame or pair. Throws
/// host::InputError: faults or suns of a source whose raw data are simulated, an empty interval of time, output that
/// cannot be written.
void write_raw_approach(const RawApproach& approach, const std::filesystem::path& folder,
                        const std::function<void()>& written);

}  // namespace pharos::sim
