// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "host/table/edges_reader.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/pulse_feed.hpp"
#include "tools/sim/truth_log.hpp"

namespace pharos::sim {

/// What is played, a scenario (.toml) or a recording: where its pulses come from and what its clock says.
struct PlaybackInput {
  std::unique_ptr<LighthouseSimulator> simulator;  // of a scenario
  std::unique_ptr<host::EdgesReader> edges;        // of a recording
  std::unique_ptr<PulseFeed> feed;
  PlayClock clock;
  std::uint32_t sensors = 0xFFFFFFFF;  // bit per sensor
};

/// Throws host::InputError where the file is neither or holds no pulses.
PlaybackInput open_playback_input(const std::string& path, std::uint64_t seed);
/// Its truth, to be written to `file`, in the body frame of the nominal sensor positions: where sensors have errors,
/// the true ones lie on those by least squares. Throws host::InputError for a recording, which has none.
PlayTruth truth_of(const PlaybackInput& input, const std::string& file);

}  // namespace pharos::sim
